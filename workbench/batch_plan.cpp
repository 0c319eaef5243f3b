// Which runs there are, what they are called, and which wait for which.

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/base/failure.hpp"
#include "core/base/sha256.hpp"
#include "core/base/text.hpp"
#include "workbench/batch.hpp"

namespace beadwork {

namespace fs = std::filesystem;

namespace {

/// Which deck it is varies first where there are several.
constexpr const char* deck_column = "deck";

using Values = std::vector<std::pair<std::string, std::string>>;

/// Of the values, without what a folder's name should not have; of 200 letters at most, a long one ends in a check sum
/// of all of it.
std::string folder_name(const Values& values) {
  constexpr std::size_t longest = 200, sum = 12;
  std::vector<std::string> pieces;
  for (const auto& [name, value] : values) pieces.push_back(name + "=" + value);
  const std::string whole = pieces.empty() ? "run" : join(pieces, ",");
  const std::string name = as_file_name(whole);
  if (name.size() <= longest) return name;
  return name.substr(0, longest - sum - 1) + "_" + sha256(whole).substr(0, sum);
}

std::string title_of(const Values& values, const std::string& name) {
  std::string title;
  for (const auto& [parameter, value] : values) title += (title.empty() ? "" : ", ") + parameter + "=" + value;
  return title.empty() ? name : title;
}

BatchRun run_of(const RunList& list, const std::string& deck, const std::vector<std::string>& row,
                const DeckArguments& common, const fs::path& out) {
  BatchRun run;
  if (list.decks.size() > 1) run.values.emplace_back(deck_column, fs::path(deck).stem().string());
  for (std::size_t k = 0; k < row.size(); ++k) run.values.emplace_back(list.parameters[k], row[k]);
  run.name = folder_name(run.values);
  run.title = title_of(run.values, run.name);
  run.sweep = list.name;
  if (!list.name.empty()) {
    run.name = list.name + "/" + run.name;
    run.title = list.name + ": " + run.title;
  }
  run.folder = out / run.name;
  run.deck = common;
  run.deck.path = deck;
  for (std::size_t k = 0; k < row.size(); ++k) run.deck.settings.push_back(list.parameters[k] + "=" + row[k]);
  for (const Override& each : list.fixed) run.deck.settings.push_back(each.name + "=" + each.value);
  for (const auto& [parameter, other] : list.from)
    run.deck.settings.push_back(parameter + "=" + (out / other).string());
  return run;
}

void refuse_twins(const std::vector<BatchRun>& runs, const fs::path& out) {
  std::map<std::string, const BatchRun*> by_folder;
  for (const BatchRun& run : runs)
    if (const auto [twin, is_new] = by_folder.emplace(run.name, &run); !is_new)
      throw DeckFailure(fmt::format(
          "error: the runs with {} and with {} would write the same folder, '{}': give values, and decks, whose names "
          "differ in letters and digits",
          shell_quoted(twin->second->title), shell_quoted(run.title), (out / run.name).string()));
}

std::vector<std::string> waits_for(const RunList& list) {
  std::vector<std::string> names = list.after;
  for (const auto& [parameter, name] : list.from) names.push_back(name);
  return names;
}

/// The lists of a name, with the places of their runs.
class Lists {
 public:
  explicit Lists(const std::vector<RunList>& lists) : lists_(lists) {
    for (const RunList& list : lists)
      if (list.name.starts_with("batch.") || list.name == "means.csv" || list.name == "claims.csv" ||
          list.name == "figures.json" || list.name == "report.html")
        refuse(list.at, fmt::format("'{}' is the name of a file of the batch: call the sweep otherwise", list.name));
    for (std::size_t k = 0; k < lists.size(); ++k)
      if (!index_.emplace(lists[k].name, k).second)
        refuse(lists[k].at, fmt::format("there is a sweep '{}' already", lists[k].name));
    for (const RunList& list : lists)
      for (const std::string& name : waits_for(list))
        if (!index_.contains(name))
          refuse(list.at, fmt::format("'{}' waits for '{}', and there is no such sweep{}", list.name, name,
                                      did_you_mean(name, names())));
    for (const RunList& list : lists) refuse_circles(list, {list.name});
  }
  std::size_t at(const std::string& name) const { return index_.at(name); }

 private:
  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const RunList& list : lists_) all.push_back(list.name);
    return all;
  }
  void refuse_circles(const RunList& list, std::vector<std::string> chain) {
    if (is_free_.contains(list.name)) return;
    for (const std::string& name : waits_for(list)) {
      const bool is_circle = std::find(chain.begin(), chain.end(), name) != chain.end();
      chain.push_back(name);
      if (is_circle) refuse(list.at, "sweeps wait for one another: " + join(chain, " waits for "));
      refuse_circles(lists_[at(name)], chain);
      chain.pop_back();
    }
    is_free_.insert(list.name);
  }
  const std::vector<RunList>& lists_;
  std::map<std::string, std::size_t> index_;
  std::set<std::string> is_free_;  ///< from which no way leads back
};

/// The values of what both lists vary, as one text; which deck it is tells nothing.
std::string shared_values(const BatchRun& run, const RunList& one, const RunList& other) {
  std::string text;
  for (const std::string& name : one.parameters)
    if (std::find(other.parameters.begin(), other.parameters.end(), name) != other.parameters.end())
      for (const auto& [its_name, value] : run.values)
        if (its_name == name) text += name + "=" + value + "\n";
  return text;
}

using Places = std::pair<std::size_t, std::size_t>;  ///< of a list's runs: from, to

void add_needs(std::vector<BatchRun>& runs, const RunList& list, Places own, const RunList& other, Places its) {
  std::map<std::string, std::vector<std::size_t>> by_values;
  for (std::size_t k = its.first; k < its.second; ++k) by_values[shared_values(runs[k], list, other)].push_back(k);
  for (std::size_t k = own.first; k < own.second; ++k) {
    const auto found = by_values.find(shared_values(runs[k], list, other));
    if (found == by_values.end())
      refuse(list.at, fmt::format("'{}' waits for '{}', and none of its runs has the values of {}", list.name,
                                  other.name, runs[k].title));
    runs[k].needs.insert(runs[k].needs.end(), found->second.begin(), found->second.end());
  }
}

}  // namespace

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

RunList list_of(const std::vector<std::string>& decks, const std::vector<Variation>& variations) {
  constexpr std::size_t most = 1000000;
  RunList list{"", {}, decks, {}, {{}}, {}, {}, {}};
  for (const Variation& variation : variations) {
    if (std::find(list.parameters.begin(), list.parameters.end(), variation.name) != list.parameters.end())
      throw DeckFailure(fmt::format("error: --vary {} is given twice", variation.name));
    if (list.rows.size() * variation.values.size() > most)
      throw DeckFailure(
          fmt::format("error: --vary {} makes more than {} runs of all combinations", variation.name, most));
    list.parameters.push_back(variation.name);
    std::vector<std::vector<std::string>> longer;
    for (const auto& row : list.rows)
      for (const std::string& value : variation.values) {
        longer.push_back(row);
        longer.back().push_back(value);
      }
    list.rows = std::move(longer);
  }
  return list;
}

std::vector<BatchRun> runs_of(const std::vector<RunList>& lists, const DeckArguments& common, const fs::path& out) {
  const Lists known(lists);
  std::error_code error;  // however it is written, one folder has one name: it stands in the decks of its runs
  fs::path root = fs::weakly_canonical(fs::absolute(out), error);
  if (error) root = fs::absolute(out);
  if (root.filename().empty()) root = root.parent_path();
  std::vector<BatchRun> runs;
  std::vector<Places> places;
  for (const RunList& list : lists) {
    const std::size_t first = runs.size();
    for (const std::string& deck : list.decks)
      for (const auto& row : list.rows) runs.push_back(run_of(list, deck, row, common, root));
    places.emplace_back(first, runs.size());
  }
  refuse_twins(runs, out);
  for (std::size_t k = 0; k < lists.size(); ++k)
    for (const std::string& name : waits_for(lists[k]))
      add_needs(runs, lists[k], places[k], lists[known.at(name)], places[known.at(name)]);
  return runs;
}

std::vector<std::string> parameters_of(const std::vector<BatchRun>& runs) {
  std::vector<std::string> names;
  std::set<std::string> seen;
  for (const BatchRun& run : runs)
    for (const auto& [name, value] : run.values)
      if (seen.insert(name).second) names.push_back(name);
  return names;
}

}  // namespace beadwork
