// The comparison of runs: their curves over one another, what differs in their decks, and what came of it.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/base/failure.hpp"
#include "core/base/text.hpp"
#include "core/deck/write.hpp"
#include "core/io/file.hpp"
#include "workbench/report/overlay.hpp"
#include "workbench/report/report.hpp"
#include "workbench/report/results.hpp"
#include "workbench/report/sections.hpp"
#include "workbench/report/text.hpp"

namespace beadwork {
namespace report {

namespace {

namespace fs = std::filesystem;

/// Texts by name, in the order of the first run that has each; empty where a run has none.
class Rows {
 public:
  explicit Rows(std::size_t runs) : runs_(runs) {}
  void set(const std::string& name, std::size_t run, const std::string& value) {
    auto [found, is_new] = values_.try_emplace(name, runs_);
    if (is_new) names_.push_back(name);
    found->second[run] = value;
  }
  const std::vector<std::string>& names() const { return names_; }
  const std::vector<std::string>& at(const std::string& name) const { return values_.at(name); }
  /// Among those runs that have what it is a part of.
  bool differs(const std::string& name) const {
    const auto& row = at(name);
    const auto whole = values_.find(whole_of(name));
    const std::string* first = nullptr;
    for (std::size_t k = 0; k < runs_; ++k) {
      if (whole != values_.end() && whole->second[k].empty()) continue;
      if (first && row[k] != *first) return true;
      first = &row[k];
    }
    return false;
  }

 private:
  /// "bond / spring a" of "bond / spring a: young", "bond" of "bond / spring a".
  static std::string whole_of(const std::string& name) {
    const std::size_t colon = name.find(": "), slash = name.rfind(" / ");
    if (colon != std::string::npos) return name.substr(0, colon);
    return slash == std::string::npos ? "" : name.substr(0, slash);
  }

  std::size_t runs_;
  std::vector<std::string> names_;
  std::map<std::string, std::vector<std::string>> values_;
};

/// What tells a tag from others of its name in one section.
std::string named(const PlainNode& node) {
  for (const char* key : {"name", "set", "of", "between"})
    if (const PlainAttribute* attribute = node.find(key)) return node.tag + " " + attribute->value;
  return node.tag;
}

/// "bond / cohesive-beam resin: young" = "7.77e+11 Pa" for each attribute; tags of one name and description are
/// counted.
void add_deck(const PlainNode& node, const std::string& way, std::size_t run, Rows& rows) {
  for (const PlainAttribute& attribute : node.attributes) rows.set(way + ": " + attribute.name, run, attribute.value);
  std::map<std::string, int> met;
  for (const PlainNode& child : node.children) {
    const std::string name = named(child);
    const int twin = ++met[name];
    const std::string place = (way == "scene" ? "" : way + " / ") + name + (twin > 1 ? fmt::format(" ({})", twin) : "");
    rows.set(place, run, "yes");
    add_deck(child, place, run, rows);
  }
}

std::string head_of(const std::vector<std::string>& labels) {
  std::string head = "<th></th>";
  for (const std::string& label : labels) head += "<th>" + escaped(label) + "</th>";
  return "<thead><tr>" + head + "</tr></thead>";
}

std::string table_of(const std::vector<std::string>& labels, const std::string& body) {
  if (body.empty()) return "";
  return "<div style=\"overflow-x:auto\"><table>" + head_of(labels) + "<tbody>" + body + "</tbody></table></div>";
}

std::string decks_table(const Rows& rows, const std::vector<std::string>& labels) {
  std::string body;
  for (const std::string& name : rows.names()) {
    if (!rows.differs(name)) continue;
    const auto& row = rows.at(name);
    const bool is_tag = name.find(": ") == std::string::npos;
    body += "<tr><th>" + escaped(is_tag ? name + " (the tag)" : name) + "</th>";
    for (const std::string& value : row) body += "<td>" + escaped(value.empty() ? "–" : value) + "</td>";
    body += "</tr>\n";
  }
  return table_of(labels, body);
}

/// A number, and by how much it is more than that of the first run.
std::string compared(const std::string& value, const std::string& first) {
  const auto here = parse_number(value), there = parse_number(first);
  if (!here) return escaped(value.empty() ? "–" : value);
  if (!there || *there == 0 || *here == *there) return number(*here);
  const double more = 100 * (*here / *there - 1);
  return std::abs(more) < 1000 ? fmt::format("{} <small>{:+.3g} %</small>", number(*here), more) : number(*here);
}

std::string results_table(const Rows& rows, const std::vector<std::string>& labels) {
  std::string body;
  for (const std::string& name : rows.names()) {
    const auto& row = rows.at(name);
    body += "<tr><th>" + escaped(name) + "</th>";
    for (std::size_t k = 0; k < row.size(); ++k) body += "<td>" + compared(row[k], k ? row[0] : "") + "</td>";
    body += "</tr>\n";
  }
  return table_of(labels, body);
}

/// The last parts of their paths that tell them apart.
std::vector<std::string> labels_of(const std::vector<fs::path>& folders) {
  std::vector<fs::path> whole;
  for (const fs::path& folder : folders) {
    fs::path path = fs::absolute(folder).lexically_normal();
    if (path.filename().empty()) path = path.parent_path();
    whole.push_back(path);
  }
  std::size_t longest = 1;
  for (const fs::path& path : whole)
    longest = std::max(longest, static_cast<std::size_t>(std::distance(path.begin(), path.end())));
  std::vector<std::string> labels;
  for (std::size_t parts = 1; parts <= longest; ++parts) {
    labels.clear();
    for (const fs::path& path : whole) {
      const auto all = std::distance(path.begin(), path.end());
      auto it = path.begin();
      std::advance(it, std::max<std::ptrdiff_t>(0, all - static_cast<std::ptrdiff_t>(parts)));
      fs::path label;
      for (; it != path.end(); ++it) label /= *it;
      labels.push_back(label.string());
    }
    if (std::set<std::string>(labels.begin(), labels.end()).size() == labels.size()) break;
  }
  return labels;
}

std::string comparison_page(const std::vector<fs::path>& folders) {
  const std::vector<std::string> labels = labels_of(folders);
  Overlay overlay;
  Rows decks(folders.size()), results(folders.size());
  for (std::size_t k = 0; k < folders.size(); ++k) {
    Run run = open_run(folders[k]);
    overlay.add(folders[k], labels[k]);
    if (const auto deck = read_resolved_xml(run.deck)) add_deck(*deck, "scene", k, decks);
    results.set("status", k, run.status);
    for (const char* name :
         {"elements", "steps", "time", "time_step", "wall_seconds", "loop_seconds", "peak_memory_bytes"})
      if (run.summary.contains(name) && run.summary[name].is_number()) results.set(name, k, run.summary[name].dump());
    for (const auto& [name, value] : results_of(folders[k])) results.set(name, k, value);
  }
  const std::string differing = decks_table(decks, labels);
  const std::string title = escaped(join(labels, " – "));
  return page_with(title + " – Beadwork",
                   "<h1>" + title + "</h1><p>" + plural(static_cast<std::int64_t>(folders.size()), "run") + "</p>",
                   overlay.notes() + overlay.charts() +
                       section("What differs in their decks", differing.empty() ? "<p>Nothing.</p>" : differing) +
                       section("What came of them", results_table(results, labels)));
}

}  // namespace
}  // namespace report

std::string write_comparison(const std::vector<std::filesystem::path>& folders, const std::filesystem::path& file) {
  return report::put_page_at(file, report::comparison_page(folders));
}

}  // namespace beadwork
