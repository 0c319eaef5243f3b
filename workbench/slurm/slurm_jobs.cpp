// How jobs are found again and followed.

#include "workbench/slurm/slurm_jobs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <thread>

#include "core/base/failure.hpp"
#include "core/io/file.hpp"

namespace beadwork::slurm {

namespace {

// A failing run may say a lot: the end of it.
std::string log_text(const std::filesystem::path& log) {
  constexpr std::streamoff most = 1 << 20;
  std::ifstream file(log, std::ios::binary | std::ios::ate);
  const std::streamoff size = file ? static_cast<std::streamoff>(file.tellg()) : 0;
  file.seekg(std::max<std::streamoff>(0, size - most));
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

SlurmJobs::SlurmJobs(Options options, Controller& controller)
    : options_(std::move(options)), controller_(controller), ledger_(options_.ledger) {}

std::size_t SlurmJobs::count(At at) const {
  return static_cast<std::size_t>(
      std::count_if(own_.begin(), own_.end(), [at](const Own& own) { return own.at == at; }));
}

std::vector<std::string> SlurmJobs::left() const {
  std::set<std::string> arrays;
  for (const Own& own : own_)
    if (own.at == At::queued) arrays.insert(own.array);
  return {arrays.begin(), arrays.end()};
}

std::filesystem::path SlurmJobs::file_of(const Own& own, const char* ending) const {
  return options_.desk / fmt::format("{}_{}.{}", own.array, task(own), ending);
}

void SlurmJobs::run(const std::vector<Job>& jobs, JobEvents& events) {
  jobs_ = &jobs;
  events_ = &events;
  own_.assign(jobs.size(), Own{});
  names_.clear();
  for (std::size_t k = 0; k < jobs.size(); ++k) names_[jobs[k].name] = k;
  if (jobs.empty()) return;
  limits_ = controller_.limits();
  take_up();
  while (!is_interrupted()) {
    submit_what_can();
    if (!options_.follow && !is_unsure_) break;
    if (with_slurm() + not_taken() == 0) break;
    rest();
    look();
  }
}

// What has been submitted before and has not ended.
void SlurmJobs::take_up() {
  if (ledger_.entries().empty()) return;
  const auto there = controller_.queue();
  if (!there) throw MachineFailure("error: Slurm does not tell what is in its queue; give the same command again");
  bool is_of_use = false;
  for (const Entry& entry : std::vector<Entry>(ledger_.entries())) is_of_use = adopt(entry, *there, false) || is_of_use;
  leave_out_what_ended_meanwhile();
  const auto& entries = ledger_.entries();
  is_unsure_ = std::any_of(entries.begin(), entries.end(), [](const Entry& entry) { return !entry.number; });
  if (is_unsure_) heard_since_ = Clock::now();
  if (!is_of_use) ledger_.clear();
  if (with_slurm() > 0) options_.say(fmt::format("{} of them are in Slurm's queue already", with_slurm()));
}

/// Whether any of it is in the queue or may still come there, be it of these jobs or of others that were submitted from
/// here.
bool SlurmJobs::adopt(const Entry& entry, const Queue& queue, bool ended_too) {
  bool is_at_work = false;
  std::string array;
  for (std::size_t task = 0; task < entry.jobs.size(); ++task) {
    const auto seen = queue.find({entry.word, task});
    if (seen == queue.end()) continue;
    array = seen->second.array;
    is_at_work = is_at_work || !seen->second.has_ended();
    const auto known = names_.find(entry.jobs[task]);
    if (known == names_.end() || (seen->second.has_ended() && !ended_too)) continue;
    Own& own = own_[known->second];
    if (own.at != At::start) continue;
    own.at = At::queued;
    own.place = {entry.word, task};
    own.array = array;
  }
  if (!entry.number && !array.empty()) ledger_.answered(entry.word, array);
  return is_at_work || (!entry.number && array.empty());
}

// Between the check of the decks and now.
void SlurmJobs::leave_out_what_ended_meanwhile() {
  std::set<std::size_t> were_submitted;
  for (const Entry& entry : ledger_.entries())
    for (const std::string& name : entry.jobs)
      if (const auto known = names_.find(name); known != names_.end()) were_submitted.insert(known->second);
  for (const std::size_t k : were_submitted)
    if (own_[k].at == At::start && events_->turn_of(k) == Turn::now && events_->was_done_elsewhere(k))
      own_[k].at = At::over;
}

void SlurmJobs::look() {
  const auto there = controller_.queue();
  if (!there) {
    if (!silence_was_told_) options_.say("Slurm does not answer; its jobs go on, and it is asked again");
    silence_was_told_ = true;
    return;
  }
  silence_was_told_ = false;
  if (is_unsure_) look_for_unsure(*there);
  for (std::size_t k = 0; k < own_.size(); ++k)
    if (own_[k].at == At::queued) look_at(k, *there);
}

// What Slurm never said that it took is in its queue, or, once it has answered for a while, nowhere.
void SlurmJobs::look_for_unsure(const Queue& queue) {
  if (!heard_since_) heard_since_ = Clock::now();
  if (Clock::now() - *heard_since_ < options_.answers_within) return;
  for (const Entry& entry : std::vector<Entry>(ledger_.entries())) {
    if (entry.number) continue;
    adopt(entry, queue, true);
    const auto& now = ledger_.entries();
    const bool is_found =
        std::any_of(now.begin(), now.end(), [&](const Entry& e) { return e.word == entry.word && e.number; });
    if (!is_found) ledger_.answered(entry.word, "");
  }
  is_unsure_ = false;
}

void SlurmJobs::look_at(std::size_t job, const Queue& queue) {
  Own& own = own_[job];
  const auto found = queue.find(own.place);
  if (found != queue.end() && found->second.is_waiting()) {
    own.share = 0;  // perhaps once more
    own.began = false;
    own.odd_since.reset();
    note_held(job, found->second);
    return;
  }
  const auto note = read_note(file_of(own, "note"));
  if (note && note->end && note->end->code == 0) {
    note_begun(job, note);
    end(job, *note->end);
  } else if (found == queue.end()) {
    settle(job, controller_.state_of_gone(own.array, task(own)), "", note);
  } else if (found->second.has_ended()) {
    settle(job, found->second.state, found->second.reason, note);
  } else if (found->second.is_running()) {
    own.odd_since.reset();
    note_begun(job, note);
  }
}

void SlurmJobs::note_begun(std::size_t job, const std::optional<Note>& note) {
  Own& own = own_[job];
  if (!own.began) events_->began(job);
  own.began = true;
  if (note && !note->end) own.share = note->share;
}

// What will not change by itself is told, once for an array.
void SlurmJobs::note_held(std::size_t job, const Seen& seen) {
  for (const char* sign : {"Held", "held", "BadConstraints", "PartitionTimeLimit", "PartitionNodeLimit", "NeverSatisf"})
    if (seen.reason.find(sign) != std::string::npos && held_told_.insert(seen.array + seen.reason).second)
      events_->is_held_up(job, fmt::format("job {} waits in Slurm's queue: {}", seen.array, seen.reason));
}

bool SlurmJobs::is_odd_for(Own& own, std::chrono::seconds patience) {
  if (!own.odd_since) own.odd_since = Clock::now();
  return Clock::now() - *own.odd_since >= patience;
}

/// Slurm says that it has ended.
void SlurmJobs::settle(std::size_t job, const std::string& state, const std::string& reason,
                       const std::optional<Note>& note) {
  constexpr std::chrono::seconds late_files{60},
      late_queue{2};  // a file system may show what another machine wrote late
  Own& own = own_[job];
  const bool has_note = note && note->end;
  if (!has_note && !is_odd_for(own, state == "COMPLETED" ? late_files : late_queue)) return;
  if (!own.may_begin) {  // perhaps it never could
    const Turn turn = events_->turn_of(job);
    if (turn == Turn::later) return;
    own.may_begin = turn == Turn::now;
    if (turn == Turn::never) return leave(own);
  }
  if (!has_note && events_->was_done_elsewhere(job)) return leave(own);
  const bool by_itself = state == "COMPLETED" || state == "FAILED" || state.empty();
  JobEnd ending = has_note ? *note->end : JobEnd{static_cast<int>(ExitCode::machine), told(state, reason)};
  if (has_note && !by_itself) ending.by = told(state, reason);
  end(job, std::move(ending));
}

void SlurmJobs::end(std::size_t job, JobEnd ending) {
  Own& own = own_[job];
  const auto log = file_of(own, "log");
  const std::string text = log_text(log);
  if (!text.empty()) events_->said(job, text);
  if (!text.empty() && ending.code != 0) ending.log = log;
  events_->ended(job, ending);
  leave(own, ending.log.empty());
}

void SlurmJobs::leave(Own& own, bool with_log) {
  own.at = At::over;
  if (room_) room_ = is_probe_ ? 1 : *room_ + 1;
  is_probe_ = false;
  std::error_code gone_already;
  std::filesystem::remove(file_of(own, "note"), gone_already);
  if (with_log) std::filesystem::remove(file_of(own, "log"), gone_already);
}

// The longer it goes on, the less often Slurm is asked: its controller serves many.
void SlurmJobs::rest() {
  using std::chrono::duration_cast, std::chrono::milliseconds;
  constexpr milliseconds longest{20000}, slice{100};
  const milliseconds pause =
      std::clamp(duration_cast<milliseconds>(Clock::now() - began_) / 20, options_.shortest_rest, longest);
  const auto until = Clock::now() + pause;
  std::vector<JobShare> shares;
  for (std::size_t k = 0; k < own_.size(); ++k)
    if (own_[k].at == At::queued && own_[k].began) shares.push_back({k, own_[k].share});
  while (!is_interrupted() && Clock::now() < until) {
    events_->at_work(shares);
    std::this_thread::sleep_for(std::min(slice, options_.shortest_rest));
  }
}

}  // namespace beadwork::slurm
