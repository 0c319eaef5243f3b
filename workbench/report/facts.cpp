// Key facts, breaks, deck and log.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/loop/json_text.hpp"
#include "workbench/report/chart.hpp"
#include "workbench/report/sections.hpp"
#include "workbench/report/table.hpp"
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
  if (!value.is_number()) return escaped(json_text(value));
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

/// Takes the breaks out whose time or energy is no number; returns how many.
std::size_t leave_out_odd(record::Breaks& log) {
  const auto odd = [&](std::size_t i) {
    return !(std::abs(log.time[i]) <= largest_drawn) ||
           (i < log.energy.size() && !(std::abs(log.energy[i]) <= largest_drawn));
  };
  record::Breaks sound;
  for (std::size_t i = 0; i < log.time.size(); ++i) {
    if (odd(i)) continue;
    sound.time.push_back(log.time[i]);
    sound.mode.push_back(log.mode[i]);
    if (i < log.energy.size()) sound.energy.push_back(log.energy[i]);
  }
  const std::size_t left_out = log.time.size() - sound.time.size();
  if (left_out > 0) log = std::move(sound);
  return left_out;
}

std::string breaks_over_time(const record::Breaks& log, double end) {
  std::map<std::string, std::vector<double>> times;
  for (std::size_t i = 0; i < log.time.size(); ++i) times[log.mode[i]].push_back(log.time[i]);
  if (!log.time.empty()) end = std::max(end, *std::max_element(log.time.begin(), log.time.end()));
  const Scale scale = readable("s", end);
  Chart chart;
  chart.title = "Broken bonds over time";
  chart.x_name = "time";
  chart.x_unit = scale.unit;
  chart.x_label = with_unit("time", scale.unit);
  chart.y_label = "bonds broken so far";
  for (auto& [mode, when] : times) {
    std::sort(when.begin(), when.end());
    Series series{spaced(mode), {0}, {0}, static_cast<int>(chart.series.size() + 5) % 8};
    // A step at each moment: nothing is broken by half in between.
    for (std::size_t i = 0; i < when.size(); ++i) {
      series.x.insert(series.x.end(), 2, when[i] * scale.factor);
      series.y.insert(series.y.end(), {static_cast<double>(i), static_cast<double>(i + 1)});
    }
    series.x.push_back(end * scale.factor);
    series.y.push_back(static_cast<double>(when.size()));
    chart.series.push_back(std::move(series));
  }
  return chart.series.empty() ? "" : figure(chart);
}

std::string tail(const std::string& text, int lines) {
  std::size_t start = text.size();
  if (start > 0 && text.back() == '\n') --start;
  for (int i = 0; i < lines && start != std::string::npos && start > 0; ++i) start = text.rfind('\n', start - 1);
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
  static constexpr std::array<const char*, 8> elsewhere = {"status", "exit_reason", "name",        "energy",
                                                           "breaks", "packing",     "utilisation", "quality"};
  std::string tiles;
  for (const char* key : headline) {
    const auto value = run.summary.find(key);
    if (value == run.summary.end()) continue;
    std::string text;
    if (value->is_object()) {
      for (const auto& [family, number_of] : value->items())
        text += (text.empty() ? "" : "<br>") + shown(family, number_of, "") + " <small>" + escaped(family) + "</small>";
    } else {
      text = shown(key, *value, "");
    }
    tiles += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>", escaped(title_of(key)), text);
  }
  Json rest = Json::object();
  for (const auto& [key, value] : run.summary.items()) {
    const auto same = [&k = key](const char* known) { return k == known; };
    if (std::none_of(headline.begin(), headline.end(), same) && std::none_of(elsewhere.begin(), elsewhere.end(), same))
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
  if (const auto odd = static_cast<std::int64_t>(leave_out_odd(log)); odd > 0)
    table += "<p class=\"note\">Left out: " + plural(odd, "break") +
             " whose time or energy is no number, infinite or too large.</p>";
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
  return section("Breaks", "<div class=\"beside\">" + breaks_over_time(log, run.summary.value("time", 0.0)) + "<div>" +
                               table + words + ".</p></div></div>");
}

std::string deck_and_log(const Run& run) {
  std::string body;
  if (!run.deck.empty())
    body += "<details><summary>The deck, as it was understood</summary><pre>" + escaped(run.deck) + "</pre></details>";
  if (!run.log.empty())
    body += "<details><summary>The end of the log</summary><pre>" + escaped(tail(run.log, 60)) + "</pre></details>";
  return section("Deck and log", body);
}

}  // namespace beadwork::report
