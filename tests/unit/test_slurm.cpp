#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/failure.hpp"
#include "tests/support/scratch.hpp"
#include "workbench/slurm/ledger.hpp"
#include "workbench/slurm/note.hpp"
#include "workbench/slurm/pieces.hpp"
#include "workbench/slurm/queue.hpp"
#include "workbench/slurm/slurm_jobs.hpp"
#include "workbench/slurm/tool.hpp"

using namespace beadwork;
using namespace beadwork::slurm;
using beadwork::testing::Scratch;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

namespace {

constexpr std::size_t any_bytes = 1000000;

std::vector<Wanted> jobs(std::size_t count) {
  std::vector<Wanted> all;
  for (std::size_t k = 0; k < count; ++k) all.push_back({k, {}, 10});
  return all;
}

TEST(SlurmPieces, no_array_is_larger_than_slurm_takes) {
  const auto pieces = pieces_of(jobs(7), 3, any_bytes, 0, {});
  ASSERT_EQ(pieces.size(), 3u);
  EXPECT_THAT(pieces[0].jobs, ElementsAre(0, 1, 2));
  EXPECT_THAT(pieces[2].jobs, ElementsAre(6));
  const auto by_bytes = pieces_of(jobs(4), 100, 25, 0, {});
  ASSERT_EQ(by_bytes.size(), 2u);
  EXPECT_THAT(by_bytes[0].jobs, ElementsAre(0, 1));
}

TEST(SlurmPieces, jobs_wait_only_for_what_they_need) {
  const auto pieces = pieces_of({{5, {1}, 1}, {6, {2}, 1}, {7, {1}, 1}}, 100, any_bytes, 0, {1, 2, 3});
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_THAT(pieces[0].jobs, ElementsAre(5, 7));
  EXPECT_THAT(pieces[0].needs, ElementsAre(1));
  EXPECT_THAT(pieces[1].needs, ElementsAre(2));
}

TEST(SlurmPieces, many_small_arrays_become_one_that_waits_for_all) {
  std::vector<Wanted> pairs;
  for (std::size_t k = 0; k < 500; ++k) pairs.push_back({500 + k, {k}, 1});
  const auto pieces = pieces_of(pairs, 1000, any_bytes, 0, {});
  ASSERT_EQ(pieces.size(), 1u);
  EXPECT_EQ(pieces[0].needs.size(), 500u);
}

TEST(SlurmPieces, arrays_share_how_many_may_be_at_work_at_once) {
  const auto pieces = pieces_of(jobs(10), 3, any_bytes, 3, {20});
  ASSERT_EQ(pieces.size(), 4u);
  std::size_t at_once = 0;
  for (const Piece& piece : pieces) {
    EXPECT_THAT(piece.needs, ElementsAre(20));
    if (piece.behind.empty()) at_once += piece.at_once;
  }
  EXPECT_EQ(at_once, 3u);
  EXPECT_THAT(pieces[3].behind, ElementsAre(0));
  const auto uneven = pieces_of(jobs(6), 3, any_bytes, 5, {});
  EXPECT_EQ(uneven[0].at_once, 3u);
  EXPECT_EQ(uneven[1].at_once, 2u);
}

TEST(SlurmQueue, limits_are_those_of_its_configuration) {
  const std::string config =
      "MaxArraySize            = 5001\nSchedulerParameters     = bf_interval=1,max_array_tasks=200\n";
  EXPECT_EQ(limits_in(config).tasks, 200u);
  EXPECT_EQ(limits_in("MaxArraySize = 11\n").tasks, 11u);
  EXPECT_EQ(limits_in("SchedulerParameters = max_script_size=4000\n").bytes, 3000u);
}

TEST(SlurmQueue, a_task_is_known_by_the_word_of_its_array) {
  const auto all = queue_in("word|2|RUNNING|17|None\nother|0|OUT_OF_MEMORY|18|a|b\n(null)|N/A|PENDING|19|Priority\n\n");
  ASSERT_EQ(all.size(), 2u);
  EXPECT_TRUE(all.at({"word", 2}).is_running());
  EXPECT_EQ(all.at({"word", 2}).array, "17");
  EXPECT_TRUE(all.at({"other", 0}).has_ended());
  EXPECT_EQ(all.at({"other", 0}).reason, "a|b");
}

TEST(SlurmQueue, why_a_job_has_ended_is_told_apart) {
  EXPECT_EQ(told("TIMEOUT"), "Slurm: TIMEOUT, it took longer than it was given");
  EXPECT_EQ(told("NODE_FAIL", "None"), "Slurm: NODE_FAIL, its node failed");
  EXPECT_EQ(told("FAILED", "RaisedSignal:9(Killed)"), "Slurm: FAILED (RaisedSignal:9(Killed))");
  EXPECT_EQ(told("CANCELLED", "None"), "Slurm: CANCELLED");
}

TEST(SlurmQueue, words_of_the_user_are_options_and_not_the_batch_s_own) {
  EXPECT_THAT(user_options({"--partition=long  --time=4:00:00", "-A mine"}),
              ElementsAre("--partition=long", "--time=4:00:00", "-A", "mine"));
  for (const char* text :
       {"long", "--exclusive=user x", "--array=1", "--arr=1", "-a1", "-HW", "--", "--dependency afterok:1"})
    EXPECT_THROW(user_options({text}), DeckFailure) << text;
}

TEST(SlurmTool, nothing_of_an_outer_job_is_handed_on) {
  for (const char* variable : {"SLURM_JOB_ID=1", "SBATCH_PARTITION=x", "SRUN_DEBUG=1", "SQUEUE_FORMAT=%i"})
    EXPECT_TRUE(is_of_slurm(variable)) << variable;
  for (const char* variable : {"SLURM_CONF=/etc/slurm.conf", "PATH=/bin", "MY_SLURM_JOB_ID=1"})
    EXPECT_FALSE(is_of_slurm(variable)) << variable;
}

TEST(SlurmTool, answers_come_back_whole) {
  const Answer answer = ask({"sh", "-c", "cat; echo wrong >&2; exit 3"}, std::string(1 << 20, 'x'));
  EXPECT_EQ(answer.code, 3);
  EXPECT_EQ(answer.out.size(), std::size_t{1} << 20);
  EXPECT_EQ(answer.error, "wrong\n");
  EXPECT_EQ(ask({"no-such-program-anywhere"}).code, 127);
}

TEST(SlurmLedger, what_was_meant_to_be_submitted_is_found_again) {
  const Scratch scratch;
  const auto file = scratch.path() / "batch.jobs";
  std::string word;
  {
    Ledger ledger(file);
    word = ledger.intend({"a/E=1", "b"});
    ledger.answered(word, "17");
    ledger.intend({"c"});
  }
  const auto entries = read_ledger(file);
  ASSERT_EQ(entries.size(), 2u);
  EXPECT_EQ(entries[0].word, word);
  EXPECT_THAT(entries[0].jobs, ElementsAre("a/E=1", "b"));
  EXPECT_EQ(entries[0].number, "17");
  EXPECT_FALSE(entries[1].number) << "no answer is known";
  Ledger again(file);
  again.clear();
  EXPECT_THAT(read_ledger(file), IsEmpty());
}

TEST(SlurmLedger, waits_for_what_still_submits_and_no_longer) {
  const Scratch scratch;
  const auto file = scratch.path() / "batch.jobs";
  const Ledger first(file);
  EXPECT_THROW(Ledger(file, std::chrono::milliseconds(50)), MachineFailure);
}

TEST(SlurmQueue, no_answer_is_no_refusal) {
  for (const char* text : {"sbatch: error: Batch job submission failed: Unable to contact slurm controller",
                           "sbatch: error: Batch job submission failed: Socket timed out on send/recv operation"})
    EXPECT_TRUE(refusal_in(text).is_unsure) << text;
  const Submission full =
      refusal_in("sbatch: error: Batch job submission failed: Job violates accounting/QOS policy\n");
  EXPECT_TRUE(full.is_limit);
  EXPECT_FALSE(full.is_unsure);
  const Submission wrong = refusal_in("sbatch: error: invalid partition specified: none");
  EXPECT_FALSE(wrong.is_limit || wrong.is_unsure);
}

/// A queue in memory. Each time that it is looked at, what waited runs, and what ran ends as it is to end.
class Queue : public Controller {
 public:
  explicit Queue(const Scratch& scratch) : desk(scratch.path()) {}
  Limits limits() override { return {}; }
  std::optional<std::map<Place, Seen>> queue() override {
    ++looks;
    for (auto& [place, seen] : tasks) {
      if (seen.state == "RUNNING") {
        seen.state = code == 0 ? "COMPLETED" : "FAILED";
        write_note(desk / (seen.array + "_" + std::to_string(place.second) + ".note"), {1, JobEnd{code, "it ended"}});
      }
      if (seen.state == "PENDING") seen.state = "RUNNING";
    }
    return tasks;
  }
  std::string state_of_gone(const std::string&, std::size_t) override { return ""; }
  Submission submit(const std::vector<std::string>& options, const std::string&, int) override {
    std::string word;
    std::size_t count = 0;
    for (const std::string& option : options) {
      if (option.starts_with("--comment=")) word = option.substr(10);
      if (option.starts_with("--array=0-")) count = std::stoul(option.substr(10)) + 1;
    }
    ++asked;
    if (requests_lost-- > 0) return {"", "Socket timed out", false, true};
    if (count > room()) return {"", "Job violates accounting/QOS policy", true, false};
    const std::string number = std::to_string(100 + asked);
    for (std::size_t task = 0; task < count; ++task) tasks[{word, task}] = {"PENDING", "", number};
    if (answers_lost-- > 0) return {"", "Socket timed out", false, true};
    return {number, "", false, false};
  }
  std::size_t room() const {
    std::size_t at_work = 0;
    for (const auto& [place, seen] : tasks) at_work += !seen.has_ended();
    return holds - std::min(holds, at_work);
  }
  std::filesystem::path desk;
  std::map<Place, Seen> tasks;
  std::size_t holds = 1000;
  int asked = 0, looks = 0, requests_lost = 0, answers_lost = 0, code = 0;
};

struct Ends : JobEvents {
  void ended(std::size_t job, const JobEnd& end) override { codes[job].push_back(end.code); }
  Turn turn_of(std::size_t) override { return turn; }
  bool was_done_elsewhere(std::size_t job) override { return done_elsewhere.contains(job); }
  std::map<std::size_t, std::vector<int>> codes;
  std::set<std::size_t> done_elsewhere;
  Turn turn = Turn::now;
};

void expect_each_once(const Ends& ends, std::size_t count, int code = 0) {
  EXPECT_EQ(ends.codes.size(), count);
  for (const auto& [job, codes] : ends.codes) EXPECT_THAT(codes, ElementsAre(code)) << job;
}

struct Through {
  std::size_t count;
  bool follow = true;
};
/// So many jobs through a queue.
void run(Queue& queue, Ends& ends, const Scratch& scratch, Through wish) {
  using std::chrono::milliseconds;
  SlurmJobs driver({.sbatch = {},
                    .follow = wish.follow,
                    .ledger = scratch.path() / "batch.jobs",
                    .desk = scratch.path(),
                    .shortest_rest = milliseconds(2),
                    .answers_within = milliseconds(3)},
                   queue);
  std::vector<Job> jobs;
  for (std::size_t k = 0; k < wish.count; ++k)
    jobs.push_back({"job-" + std::to_string(k), scratch.path() / std::to_string(k), {"true"}});
  driver.run(jobs, ends);
}

TEST(SlurmJobs, are_submitted_once_though_the_answer_is_lost) {
  for (const int code : {0, 3}) {
    const Scratch scratch;
    Queue queue(scratch);
    queue.answers_lost = 1;
    queue.code = code;
    Ends ends;
    run(queue, ends, scratch, {5});
    EXPECT_EQ(queue.tasks.size(), 5u) << "the first submission was taken, though nobody said so";
    expect_each_once(ends, 5, code);
  }
}

TEST(SlurmJobs, are_submitted_again_if_the_request_was_lost) {
  const Scratch scratch;
  Queue queue(scratch);
  queue.requests_lost = 2;
  Ends ends;
  run(queue, ends, scratch, {5});
  EXPECT_EQ(queue.asked, 3);
  expect_each_once(ends, 5);
}

TEST(SlurmJobs, are_not_left_before_it_is_known_whether_they_were_taken) {
  const Scratch scratch;
  Queue queue(scratch);
  queue.answers_lost = 1;
  Ends ends;
  run(queue, ends, scratch, {5, false});
  EXPECT_EQ(queue.tasks.size(), 5u) << "it does not leave before it knows";
  EXPECT_GE(queue.looks, 2);
}

TEST(SlurmJobs, that_have_ended_since_the_decks_were_checked_are_not_submitted_again) {
  const Scratch scratch;
  Queue queue(scratch);
  Ends ends;
  run(queue, ends, scratch, {3});
  Ends again;
  again.done_elsewhere = {0, 1};
  run(queue, again, scratch, {3});
  EXPECT_EQ(queue.tasks.size(), 4u);
  Ends anew;  // what they were made of is to be made anew
  anew.done_elsewhere = {0, 1, 2};
  anew.turn = Turn::later;
  run(queue, anew, scratch, {3, false});
  EXPECT_TRUE(anew.codes.empty());
}

TEST(SlurmJobs, beyond_what_a_queue_holds_are_submitted_as_others_end) {
  const Scratch scratch;
  Queue queue(scratch);
  queue.holds = 4;
  Ends ends;
  run(queue, ends, scratch, {64});
  expect_each_once(ends, 64);
  EXPECT_EQ(queue.tasks.size(), 64u);
  EXPECT_LE(queue.asked, 6 + 2 * 64 / 4) << "halved down to the room there is, then twice for as many as end";
}

TEST(SlurmJobs, fill_a_queue_that_has_more_room_again) {
  const Scratch scratch;
  struct Later : Queue {
    using Queue::Queue;
    std::optional<std::map<Place, Seen>> queue() override {
      if (looks == 4) holds = 1000;  // another user's jobs have ended
      return Queue::queue();
    }
  } later(scratch);
  later.holds = 1;
  Ends ends;
  run(later, ends, scratch, {64});
  expect_each_once(ends, 64);
  EXPECT_LE(later.looks, 4 + 3 * 8) << "by doubling";
}

TEST(SlurmNote, an_end_is_read_as_it_was_written) {
  const Scratch scratch;
  const auto file = scratch.path() / "note";
  EXPECT_FALSE(read_note(file));
  write_note(file, {0.25, {}});
  EXPECT_NEAR(read_note(file)->share, 0.25, 1e-4);
  write_note(file, {1, JobEnd{3, "exit code 3"}});
  ASSERT_TRUE(read_note(file)->end);
  EXPECT_EQ(read_note(file)->end->code, 3);
  EXPECT_EQ(read_note(file)->end->how, "exit code 3");
}

}  // namespace
