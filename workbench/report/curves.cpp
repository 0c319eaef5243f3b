// Which columns of a curve are drawn in which chart, and in which units.

#include <algorithm>
#include <cmath>
#include <limits>

#include "workbench/report/axes.hpp"
#include "workbench/report/chart.hpp"
#include "workbench/report/sections.hpp"
#include "workbench/report/text.hpp"

namespace beadwork::report {

namespace {

constexpr int colors = 8;

bool is_clock(const Column& c) { return c.name == "step" || c.name == "time"; }

double largest(const std::vector<double>& values) {
  double most = 0;
  for (const double v : values)
    if (std::isfinite(v)) most = std::max(most, std::abs(v));
  return most;
}

std::vector<double> scaled(const std::vector<double>& values, double factor) {
  std::vector<double> out(values);
  for (double& v : out) v *= factor;
  return out;
}

bool varies(const Column& column) { return range_of(column.values).span() > 0; }

/// What the sidecar names, unless it never changes (the displacement of a set that is held): then the time.
const Column* abscissa(const Curve& curve) {
  const Column* named = curve.table.find(text_of(curve.sidecar, "x"));
  if (named && (varies(*named) || curve.table.rows() < 2)) return named;
  if (const Column* time = curve.table.find("time")) return time;
  return &curve.table.columns[curve.table.columns.size() > 1 ? 1 : 0];
}

/// The columns to draw: those that the sidecar lists, else all but the clocks and x.
std::vector<const Column*> ordinates(const Curve& curve, const Column* x) {
  std::vector<const Column*> out;
  const auto listed = curve.sidecar.find("y");
  if (listed != curve.sidecar.end()) {
    for (const Json& name : listed->is_array() ? *listed : Json::array({*listed}))
      if (const Column* column = name.is_string() ? curve.table.find(name.get<std::string>()) : nullptr)
        out.push_back(column);
  }
  if (!out.empty()) return out;
  for (const Column& column : curve.table.columns)
    if (&column != x && !is_clock(column) && !column.is_reference()) out.push_back(&column);
  if (out.empty())  // nothing but references
    for (const Column& column : curve.table.columns)
      if (&column != x && !is_clock(column)) out.push_back(&column);
  return out;
}

std::string reference_label(const Column& column) {
  std::string label = column.name.substr(std::string("reference").size());
  label.erase(0, std::min(label.find_first_not_of(" :-_"), label.size()));
  return label.empty() ? "reference" : label;
}

void add_references(Chart& chart, const Curve& curve, const Column& x, const std::string& unit, const Scale& sx,
                    const Scale& sy) {
  int color = static_cast<int>(chart.series.size());
  const auto x_values = scaled(x.values, sx.factor);
  for (const Column& column : curve.table.columns)
    if (column.is_reference() && column.unit == unit && &column != &x)
      chart.series.push_back({reference_label(column), x_values, scaled(column.values, sy.factor), color++ % colors,
                              Stroke::dashed, true});
}

std::vector<Marker> markers(const Table& table, const std::vector<record::FrameHead>& pictured) {
  std::vector<Marker> out;
  for (std::size_t k = 0; k < pictured.size(); ++k) out.push_back({row_at(table, pictured[k]), std::to_string(k + 1)});
  return out;
}

/// One chart for all columns of one unit.
std::string panel(const Curve& curve, const Column& x, const std::vector<const Column*>& group, bool alone,
                  const std::vector<record::FrameHead>& pictured) {
  double most = 0;
  for (const Column* column : group) most = std::max(most, largest(column->values));
  const std::string& unit = group.front()->unit;
  const Scale sx = readable(x.unit, largest(x.values)), sy = readable(unit, most);
  Chart chart;
  const std::string named = text_of(curve.sidecar, "title", spaced(curve.name));
  const bool said = alone || group.size() > 1 || named == group.front()->name;
  chart.title = said ? named : named + ": " + group.front()->name;
  chart.x_name = x.name;
  chart.x_unit = sx.unit == "1" ? "" : sx.unit;
  chart.x_label = with_unit(chart.x_name, sx.unit);
  chart.y_label = with_unit(group.size() == 1 ? group.front()->name : "", sy.unit);
  const auto x_values = scaled(x.values, sx.factor);
  for (const Column* column : group)
    chart.series.push_back(
        {column->name, x_values, scaled(column->values, sy.factor), static_cast<int>(chart.series.size()) % colors});
  add_references(chart, curve, x, unit, sx, sy);
  if (!is_clock(x) && group.size() == 1) chart.markers = markers(curve.table, pictured);
  return figure(chart);
}

std::string charts_of(const Curve& curve, const std::vector<record::FrameHead>& pictured) {
  const Column* x = abscissa(curve);
  std::vector<std::vector<const Column*>> groups;
  for (const Column* column : ordinates(curve, x)) {
    const auto same = std::find_if(groups.begin(), groups.end(),
                                   [&](const auto& group) { return group.front()->unit == column->unit; });
    if (same == groups.end())
      groups.push_back({column});
    else
      same->push_back(column);
  }
  std::string out;
  for (const auto& group : groups) out += panel(curve, *x, group, groups.size() == 1, pictured);
  return out;
}

}  // namespace

std::size_t row_at(const Table& table, const record::FrameHead& head) {
  const Column* time = table.find("time");
  const Column* clock = time ? time : table.find("step");
  if (!clock) return std::numeric_limits<std::size_t>::max();
  const double wanted = time ? head.time : static_cast<double>(head.step);
  std::size_t best = 0;
  for (std::size_t i = 1; i < clock->values.size(); ++i)
    if (std::abs(clock->values[i] - wanted) < std::abs(clock->values[best] - wanted)) best = i;
  return best;
}

std::string loading_at(const Run& run, const record::FrameHead& head) {
  for (const Curve& curve : run.curves) {
    const Column* x = abscissa(curve);
    const std::size_t row = row_at(curve.table, head);
    if (is_ledger(curve) || is_clock(*x) || row >= x->values.size() || !curve.table.find("time")) continue;
    const Scale scale = readable(x->unit, largest(x->values));
    return x->name + " " + number(x->values[row] * scale.factor, 3) + (scale.unit == "1" ? "" : " " + scale.unit);
  }
  return "";
}

std::string overlaid(const std::vector<std::pair<std::string, const Curve*>>& of_runs) {
  const Curve& model = *of_runs.front().second;  // says what is drawn, and how
  const Column& x = *abscissa(model);
  std::string out;
  for (const Column* y : ordinates(model, &x)) {
    double most_x = 0, most_y = 0;
    std::vector<std::pair<std::string, std::pair<const Column*, const Column*>>> lines;
    for (const auto& [label, curve] : of_runs) {
      const Column *own_x = curve->table.find(x.name), *own_y = curve->table.find(y->name);
      if (!own_x || !own_y || own_x->unit != x.unit || own_y->unit != y->unit) continue;
      lines.push_back({label, {own_x, own_y}});
      most_x = std::max(most_x, largest(own_x->values));
      most_y = std::max(most_y, largest(own_y->values));
    }
    const Scale sx = readable(x.unit, most_x), sy = readable(y->unit, most_y);
    Chart chart;
    chart.title = text_of(model.sidecar, "title", spaced(model.name)) + ": " + y->name;
    chart.x_name = x.name;
    chart.x_unit = sx.unit == "1" ? "" : sx.unit;
    chart.x_label = with_unit(chart.x_name, sx.unit);
    chart.y_label = with_unit(y->name, sy.unit);
    for (const auto& [label, line] : lines) {
      const int number = static_cast<int>(chart.series.size());
      chart.series.push_back({label, scaled(line.first->values, sx.factor), scaled(line.second->values, sy.factor),
                              number % colors, number / colors % 2 ? Stroke::dashed : Stroke::solid});
    }
    out += figure(chart);
  }
  return out;
}

std::string curves(const Run& run, const std::vector<record::FrameHead>& pictured) {
  std::string body;
  for (const Curve& curve : run.curves)
    if (!is_ledger(curve)) body += charts_of(curve, pictured);
  return body.empty() ? "" : section("Curves", "<div class=\"charts\">" + body + "</div>");
}

}  // namespace beadwork::report
