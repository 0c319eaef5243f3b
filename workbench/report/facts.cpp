// Key facts, breaks, packing report, deck and log.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "workbench/report/chart.hpp"
#include "workbench/report/sections.hpp"
#include "workbench/report/text.hpp"

namespace beadwork::report {

namespace {

/// What a key is called where its value is shown with its unit.
std::string title_of(const std::string& key) {
  static const std::map<std::string, std::string> known = {{"wall_seconds", "wall time"},
                                                           {"loop_seconds", "time in the loop"},
                                                           {"seconds", "time"},
                                                           {"deck_sha256", "SHA-256 of the deck"},
                                                           {"bond_updates_per_second", "bond updates"}};
  const auto found = known.find(key);
  return found == known.end() ? spaced(key) : found->second;
}

/// A value of the summary, in the unit that its key tells.
std::string shown(const std::string& key, const Json& value, const std::string& unit) {
  if (value.is_string()) return escaped(value.get<std::string>());
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_null()) return "–";
  if (value.is_array()) {
    std::string list;
    for (const Json& entry : value) list += (list.empty() ? "" : ", ") + shown(key, entry, unit);
    return list;
  }
  if (!value.is_number()) return escaped(value.dump());
  const double v = value.get<double>();
  if (key.ends_with("bytes")) return number(v / 1e6) + " MB";
  if (key.ends_with("per_second")) return v >= 1e6 ? number(v / 1e6, 3) + " million/s" : number(v, 3) + " /s";
  if (key == "time_step") return number(v) + " s";
  if (key.ends_with("seconds")) return duration(v);
  if (value.is_number_integer()) return count(value.get<std::int64_t>()) + (unit.empty() ? "" : " " + unit);
  return number(v) + (unit.empty() ? "" : " " + unit);
}

void add_rows(std::string& out, const Json& object, const std::string& before, const std::string& unit) {
  for (const auto& [key, value] : object.items()) {
    const std::string name = before.empty() ? title_of(key) : before + ": " + title_of(key);
    if (value.is_object())
      add_rows(out, value, name, unit);
    else
      out += fmt::format("<tr><th>{}</th><td>{}</td></tr>", escaped(name), shown(key, value, unit));
  }
}

std::vector<double> reals_in(const Json& object, const char* key) {
  std::vector<double> out;
  const auto found = object.find(key);
  if (found == object.end() || !found->is_array()) return out;
  for (const Json& value : *found)
    if (value.is_number()) out.push_back(value.get<double>());
  return out;
}

bool is_histogram(const Json& value) {
  return value.is_object() && value.contains("edges") && value.contains("counts");
}

std::string histogram(const std::string& title, const Json& value) {
  Bars bars;
  bars.edges = reals_in(value, "edges");
  bars.heights = reals_in(value, "counts");
  if (bars.edges.empty()) return "";
  const Scale scale = readable(text_of(value, "unit", "m"), bars.edges.back());
  for (double& edge : bars.edges) edge *= scale.factor;
  bars.title = title;
  bars.x_label = with_unit("radius", scale.unit);
  bars.y_label = "elements";
  return figure(bars);
}

std::string breaks_over_time(const record::Breaks& log) {
  std::map<std::string, std::vector<double>> times;
  for (std::size_t i = 0; i < log.time.size(); ++i) times[log.mode[i]].push_back(log.time[i]);
  const Scale scale =
      readable("s", log.time.empty() ? 0 : *std::max_element(log.time.begin(), log.time.end()));
  Chart chart;
  chart.title = "Broken bonds over time";
  chart.x_name = "time";
  chart.x_unit = scale.unit;
  chart.x_label = with_unit("time", scale.unit);
  chart.y_label = "bonds broken so far";
  for (auto& [mode, when] : times) {
    std::sort(when.begin(), when.end());
    Series series{spaced(mode), {0}, {0}, static_cast<int>(chart.series.size() + 5) % 8};
    for (std::size_t i = 0; i < when.size(); ++i) {
      series.x.push_back(when[i] * scale.factor);
      series.y.push_back(static_cast<double>(i + 1));
    }
    chart.series.push_back(std::move(series));
  }
  return chart.series.empty() ? "" : figure(chart);
}

std::string tail(const std::string& text, int lines) {
  std::size_t start = text.size();
  if (start > 0 && text.back() == '\n') --start;
  for (int i = 0; i < lines && start != std::string::npos && start > 0; ++i)
    start = text.rfind('\n', start - 1);
  return start == std::string::npos || start == 0 ? text : text.substr(start + 1);
}

}  // namespace

std::string section(const std::string& title, const std::string& body) {
  return body.empty() ? "" : "<section><h2>" + escaped(title) + "</h2>\n" + body + "</section>\n";
}

std::string facts_table(const Json& object, const std::string& unit_of_numbers) {
  std::string rows;
  add_rows(rows, object, "", unit_of_numbers);
  return rows.empty() ? "" : "<table class=\"facts\"><tbody>" + rows + "</tbody></table>";
}

std::string facts(const Run& run) {
  static constexpr std::array<const char*, 7> headline = {
      "elements", "bonds", "steps", "time_step", "wall_seconds", "bond_updates_per_second", "threads"};
  static constexpr std::array<const char*, 7> elsewhere = {"status", "exit_reason", "scene", "energy", "breaks", "packing", "quality"};
  std::string tiles;
  for (const char* key : headline) {
    const auto value = run.summary.find(key);
    if (value == run.summary.end()) continue;
    std::string text;
    if (value->is_object()) {
      for (const auto& [family, number_of] : value->items())
        text += (text.empty() ? "" : "<br>") + shown(family, number_of, "") + " <small>" + escaped(family) +
                "</small>";
    } else {
      text = shown(key, *value, "");
    }
    tiles += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>", escaped(title_of(key)), text);
  }
  Json rest = Json::object();
  for (const auto& [key, value] : run.summary.items()) {
    const auto same = [&k = key](const char* known) { return k == known; };
    if (std::none_of(headline.begin(), headline.end(), same) &&
        std::none_of(elsewhere.begin(), elsewhere.end(), same))
      rest[key] = value;
  }
  std::string out = tiles.empty() ? "" : "<dl class=\"tiles\">" + tiles + "</dl>";
  const std::string more = facts_table(rest);
  if (out.empty())
    out = more;
  else if (!more.empty())
    out += "<details class=\"quiet\"><summary>All facts of the run</summary>" + more + "</details>";
  return out.empty() ? "" : "<section>" + out + "</section>\n";
}

std::string breaks(const Run& run) {
  std::string table;
  const auto modes = run.summary.find("breaks");
  if (modes != run.summary.end()) table = facts_table(modes->is_object() ? *modes : Json{{"breaks", *modes}});
  record::Breaks log;
  try {
    if (run.recorded) log = run.recorded->breaks();
  } catch (const std::exception& problem) {
    table += "<p class=\"note\">The log of breaks cannot be read: " + escaped(problem.what()) + ".</p>";
  }
  if (table.empty() && !log.time.empty()) {
    Json by_mode = Json::object();
    for (const std::string& mode : log.mode) by_mode[mode] = by_mode.value(mode, 0) + 1;
    table = facts_table(by_mode);
  }
  if (log.time.empty()) return section("Breaks", table);
  double energy = 0;
  for (const double e : log.energy) energy += e;
  std::string words = "<p>" + plural(static_cast<std::int64_t>(log.time.size()), "bond") + " broke";
  const Scale scale = readable("J", energy);
  if (energy > 0) words += ", releasing " + number(energy * scale.factor) + " " + scale.unit;
  return section("Breaks", "<div class=\"beside\">" + breaks_over_time(log) + "<div>" + table + words +
                               ".</p></div></div>");
}

std::string packing(const Run& run) {
  const auto found = run.summary.find("packing");
  if (found == run.summary.end()) return "";
  std::string body;
  for (const Json& report : found->is_array() ? *found : Json::array({*found})) {
    if (!report.is_object()) continue;
    Json plain = Json::object();
    std::string charts;
    for (const auto& [key, value] : report.items())
      if (is_histogram(value))
        charts += histogram(spaced(key), value);
      else
        plain[key] = value;
    body += "<div class=\"beside\">" + charts + "<div>" + facts_table(plain) + "</div></div>";
  }
  return section("Packing", body);
}

std::string deck_and_log(const Run& run) {
  std::string body;
  if (!run.deck.empty())
    body += "<details><summary>The deck, as it was understood</summary><pre>" + escaped(run.deck) +
            "</pre></details>";
  if (!run.log.empty())
    body += "<details><summary>The end of the log</summary><pre>" + escaped(tail(run.log, 60)) +
            "</pre></details>";
  return section("Deck and log", body);
}

}  // namespace beadwork::report
