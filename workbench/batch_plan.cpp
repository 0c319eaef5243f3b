// Which runs there are, what they are called, and whether their decks are in order.

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/base/failure.hpp"
#include "core/base/sha256.hpp"
#include "core/base/text.hpp"
#include "workbench/batch.hpp"

namespace beadwork {

Variation variation_of(const std::string& text) {
  const std::size_t equals = text.find('=');
  Variation variation;
  if (equals != std::string::npos) {
    variation.name = trim(text.substr(0, equals));
    for (const std::string& value : split(text.substr(equals + 1), ',')) variation.values.emplace_back(trim(value));
  }
  const bool has_empty = std::find(variation.values.begin(), variation.values.end(), "") != variation.values.end();
  if (variation.name.empty() || has_empty)
    throw DeckFailure(fmt::format("error: --vary wants name=value,value,..., got \"{}\"", text));
  return variation;
}

std::vector<std::vector<std::string>> combinations(const std::vector<Variation>& variations) {
  constexpr std::size_t most = 100000;
  std::vector<std::vector<std::string>> all{{}};
  for (const Variation& variation : variations) {
    if (all.size() * variation.values.size() > most)
      throw DeckFailure(
          fmt::format("error: --vary {} makes more than {} runs of all combinations", variation.name, most));
    std::vector<std::vector<std::string>> longer;
    for (const auto& values : all)
      for (const std::string& value : variation.values) {
        longer.push_back(values);
        longer.back().push_back(value);
      }
    all = std::move(longer);
  }
  return all;
}

std::string folder_name(const std::vector<Variation>& variations, const std::vector<std::string>& values) {
  constexpr std::size_t longest = 200, sum = 12;
  std::vector<std::string> pieces;
  for (std::size_t k = 0; k < values.size(); ++k) pieces.push_back(variations[k].name + "=" + values[k]);
  const std::string whole = pieces.empty() ? "run" : join(pieces, ",");
  const std::string name = as_file_name(whole);
  if (name.size() <= longest) return name;
  return name.substr(0, longest - sum - 1) + "_" + sha256(whole).substr(0, sum);
}

namespace {

std::string listed(const std::vector<const BatchRun*>& runs, std::size_t all) {
  constexpr std::size_t shown = 4;
  if (runs.size() == all && all > 1) return fmt::format("all {} runs", all);
  std::string text;
  for (std::size_t k = 0; k < runs.size() && k < shown; ++k) text += (k ? "; " : "") + runs[k]->title;
  if (runs.size() > shown) text += fmt::format("; and {} more", runs.size() - shown);
  return (runs.size() == 1 ? "run " : fmt::format("{} runs: ", runs.size())) + text;
}

}  // namespace

DeckCheck check_decks(std::vector<BatchRun>& runs) {
  constexpr std::size_t most_shown = 50;  // a deck of another program has a mistake in every line
  std::vector<std::string> order;
  std::map<std::string, std::vector<const BatchRun*>> who;
  const auto note = [&](const std::string& mistake, const BatchRun& run) {
    auto& those = who[mistake];
    if (those.empty()) order.push_back(mistake);
    if (those.empty() || those.back() != &run) those.push_back(&run);
  };
  std::map<std::vector<std::string>, FileSums> sums;  // of files that many runs read
  std::size_t bad = 0;
  for (BatchRun& run : runs) {
    Complaints complaints;
    std::string failure;
    ExitCode code = ExitCode::deck;
    try {
      const Loaded loaded = load_scene(run.deck.request(), complaints);
      refuse_study(loaded, run.deck.path);
      if (loaded.deck) run.deck_sha256 = loaded.deck->sha256;
      if (complaints.errors() == 0) {
        const auto files = loaded.scene->files();
        if (!sums.contains(files)) sums[files] = file_sums(files);
        run.files = sums[files];
        run.done = is_done(run);
      }
    } catch (const Fault& one) {
      code = one.code();
      failure = shown(one) + "\n";
    }
    for (const std::string& complaint : complaints.each()) note(complaint, run);
    if (!failure.empty()) note(failure, run);
    if (run.done) run.results = results_of(run.folder);
    if (complaints.errors() > 0 || !failure.empty()) {
      run.refused = true;
      run.code = static_cast<int>(code);
      ++bad;
    }
    note_row(run);
  }
  std::string text;
  for (std::size_t k = 0; k < order.size() && k < most_shown; ++k)
    text += fmt::format("{}  in {}\n", order[k], listed(who[order[k]], runs.size()));
  if (order.size() > most_shown) text += fmt::format("... and {} more\n", order.size() - most_shown);
  if (bad > 0) text += fmt::format("{} of {} runs cannot begin\n", bad, runs.size());
  return {bad, text};
}

}  // namespace beadwork
