// Which runs there are, what they are called, and whether their decks are in order.

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
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
      throw DeckFailure(fmt::format("error: --vary {} makes more than {} runs of all combinations", variation.name, most));
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
  std::string name = whole;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && std::string_view(".,=+-_").find(c) == std::string_view::npos) c = '-';
  if (name.front() == '.') name.front() = '-';
  if (name.size() <= longest) return name;
  return name.substr(0, longest - sum - 1) + "_" + sha256(whole).substr(0, sum);
}

namespace {

// Complaints of one deck, each with the line that it is about and the mark below it.
std::vector<std::string> single(const std::string& text) {
  std::vector<std::string> all;
  for (const std::string& line : split(text, '\n')) {
    const bool counts = line.find(" error") != std::string::npos && line.find(':') == std::string::npos;  // "3 errors"
    if (line.empty() || counts) continue;
    if (all.empty() || !line.starts_with(' '))
      all.push_back(line);
    else
      all.back() += "\n" + line;
  }
  return all;
}

std::string listed(const std::vector<const BatchRun*>& runs, std::size_t all) {
  constexpr std::size_t shown = 4;
  if (runs.size() == all && all > 1) return fmt::format("all {} runs", all);
  std::string text;
  for (std::size_t k = 0; k < runs.size() && k < shown; ++k) text += (k ? "; " : "") + runs[k]->title;
  if (runs.size() > shown) text += fmt::format("; and {} more", runs.size() - shown);
  return (runs.size() == 1 ? "run " : fmt::format("{} runs: ", runs.size())) + text;
}

}  // namespace

std::string check_decks(std::vector<BatchRun>& runs) {
  std::vector<std::string> order;
  std::map<std::string, std::vector<const BatchRun*>> who;
  const auto note = [&](const std::string& mistake, const BatchRun& run) {
    auto& those = who[mistake];
    if (those.empty()) order.push_back(mistake);
    if (those.empty() || those.back() != &run) those.push_back(&run);
  };
  std::size_t bad = 0;
  for (BatchRun& run : runs) {
    try {
      run.deck_sha256 = load_scene(run.deck).deck->sha256;
      run.done = is_done(run);
      if (run.done) run.results = results_of(run.folder);
    } catch (const DeckFailure& failure) {
      run.refused = true;
      run.code = static_cast<int>(ExitCode::deck);
      ++bad;
      for (const std::string& mistake : single(failure.what())) note(mistake, run);
    }
  }
  std::string text;
  for (const std::string& mistake : order) text += fmt::format("{}\n  in {}\n", mistake, listed(who[mistake], runs.size()));
  if (bad > 0) text += fmt::format("{} error{} in {} of {} runs\n", order.size(), order.size() == 1 ? "" : "s", bad, runs.size());
  return text;
}

}  // namespace beadwork
