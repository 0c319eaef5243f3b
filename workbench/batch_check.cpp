// Whether the decks of runs are in order, before anything runs.

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "core/base/failure.hpp"
#include "workbench/batch.hpp"

namespace beadwork {

namespace {

std::string listed(const std::vector<const BatchRun*>& runs, std::size_t all) {
  constexpr std::size_t shown = 4;
  if (runs.size() == all && all > 1) return fmt::format("all {} runs", all);
  std::string text;
  for (std::size_t k = 0; k < runs.size() && k < shown; ++k) text += (k ? "; " : "") + runs[k]->title;
  if (runs.size() > shown) text += fmt::format("; and {} more", runs.size() - shown);
  return (runs.size() == 1 ? "run " : fmt::format("{} runs: ", runs.size())) + text;
}

bool lacks_some(const BatchRun& run, const std::vector<BatchRun>& all) {
  return std::any_of(run.needs.begin(), run.needs.end(), [&](std::size_t need) { return !all[need].done; });
}

/// Whether a complaint is of a file that one of the runs will leave which are needed.
bool is_of_what_comes(const std::string& complaint, const BatchRun& run, const std::vector<BatchRun>& all) {
  return std::any_of(run.needs.begin(), run.needs.end(), [&](std::size_t need) {
    return !all[need].done && complaint.find(all[need].folder.parent_path().string() + "/") != std::string::npos;
  });
}

}  // namespace

void DeckChecks::note(const std::string& mistake, const BatchRun& run) {
  auto& those = who_[mistake];
  if (those.empty()) order_.push_back(mistake);
  if (those.empty() || those.back() != &run) those.push_back(&run);
}

void DeckChecks::check(BatchRun& run, const std::vector<BatchRun>& all) {
  Complaints complaints;
  std::string failure;
  ExitCode code = ExitCode::deck;
  run.postponed = false;
  try {
    const Loaded loaded = load_scene(run.deck.request(), complaints);
    if (loaded.scene && !loaded.scene->studies.empty()) {
      if (loaded.scene->studies.front()->is_of_batch()) refuse_study(loaded, run.deck.path);
      run.is_study = true;
    }
    if (loaded.deck) run.deck_sha256 = loaded.deck->sha256;
    if (complaints.errors() == 0) {
      const auto files = loaded.scene->files();
      if (!sums_.contains(files)) sums_[files] = file_sums(files);
      run.files = sums_[files];
      run.done = is_done(run);
    }
  } catch (const Fault& one) {
    code = one.code();
    failure = shown(one) + "\n";
  }
  const std::vector<std::string> each = complaints.each();
  const auto comes = [&](const std::string& complaint) { return is_of_what_comes(complaint, run, all); };
  run.postponed =
      lacks_some(run, all) && std::all_of(each.begin(), each.end(), comes) && (failure.empty() || comes(failure));
  if (run.postponed) run.done = false;  // what it was made of is made anew
  if (!run.postponed) {
    for (const std::string& complaint : each) note(complaint, run);
    if (!failure.empty()) note(failure, run);
    if (run.done) run.results = results_of(run.folder);
    run.refused = complaints.errors() > 0 || !failure.empty();
    if (run.refused) run.code = static_cast<int>(code), ++refused_;
  }
  note_row(run);
}

void DeckChecks::check_all(std::vector<BatchRun>& runs) {
  std::vector<bool> checked(runs.size());
  const std::function<void(std::size_t)> visit = [&](std::size_t k) {
    if (checked[k]) return;
    checked[k] = true;
    for (const std::size_t need : runs[k].needs) visit(need);
    check(runs[k], runs);
  };
  for (std::size_t k = 0; k < runs.size(); ++k) visit(k);
}

std::string DeckChecks::text(std::size_t all) const {
  constexpr std::size_t most_shown = 50;  // a deck of another program has a mistake in every line
  std::string text;
  for (std::size_t k = 0; k < order_.size() && k < most_shown; ++k)
    text += fmt::format("{}  in {}\n", order_[k], listed(who_.at(order_[k]), all));
  if (order_.size() > most_shown) text += fmt::format("... and {} more\n", order_.size() - most_shown);
  if (refused_ > 0) text += fmt::format("{} of {} runs cannot begin\n", refused_, all);
  return text;
}

}  // namespace beadwork
