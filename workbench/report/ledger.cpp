// The energy ledger: what was put in, where it is, and whether the two agree.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "workbench/report/chart.hpp"
#include "workbench/report/sections.hpp"
#include "workbench/report/text.hpp"

namespace beadwork::report {

namespace {

bool mentions(const std::string& name, std::initializer_list<const char*> words) {
  return std::any_of(words.begin(), words.end(), [&](const char* w) { return name.find(w) != std::string::npos; });
}

struct Account {
  std::vector<const Column*> input, stores;
  const Column* residual = nullptr;
};

/// The names say what is put in and what is there.
Account account_of(const Curve& curve) {
  Account account;
  for (const Column& column : curve.table.columns) {
    if (column.name == "step" || column.unit != "J" || column.is_reference()) continue;
    if (mentions(column.name, {"residual", "error"}))
      account.residual = &column;
    else if (mentions(column.name, {"work", "external", "input"}))
      account.input.push_back(&column);
    else if (!mentions(column.name, {"total", "sum", "balance"}))
      account.stores.push_back(&column);
  }
  return account;
}

double total(const std::vector<const Column*>& columns, std::size_t row) {
  double sum = 0;
  for (const Column* column : columns) sum += column->values[row];
  return sum;
}

/// What came in since the first row, less what is there more than then.
double residual_at(const Account& account, std::size_t row) {
  if (account.residual) return account.residual->values[row];
  return total(account.input, row) - total(account.input, 0) - (total(account.stores, row) - total(account.stores, 0));
}

double turnover(const Account& account, std::size_t rows) {
  double most = 0;
  for (std::size_t row = 0; row < rows; ++row)
    most = std::max({most, std::abs(total(account.input, row)), std::abs(total(account.stores, row))});
  return most;
}

bool can_be_stacked(const Account& account) {
  double least = 0, most = 0;
  for (const Column* column : account.stores)
    for (const double v : column->values) least = std::min(least, v), most = std::max(most, v);
  return !account.stores.empty() && least >= -0.02 * most;
}

std::string chart_of(const Curve& curve, const Account& account) {
  const Column* time = curve.table.find("time");
  const Column& x = time ? *time : curve.table.columns.front();
  const double latest = x.values.empty() ? 0 : std::abs(x.values.back());
  const Scale sx = readable(x.unit, latest), sy = readable("J", turnover(account, curve.table.rows()));
  const auto scaled = [](std::vector<double> values, double factor) {
    for (double& v : values) v *= factor;
    return values;
  };
  Chart chart;
  chart.title = text_of(curve.sidecar, "title", "Energy over time");
  chart.x_name = x.name;
  chart.x_unit = sx.unit == "1" ? "" : sx.unit;
  chart.x_label = with_unit(x.name, sx.unit);
  chart.y_label = with_unit("energy", sy.unit);
  chart.stacked = can_be_stacked(account);
  for (const auto* columns : {&account.stores, &account.input})
    for (const Column* column : *columns)
      chart.series.push_back({column->name, scaled(x.values, sx.factor), scaled(column->values, sy.factor),
                              static_cast<int>(chart.series.size()) % 7,
                              columns == &account.input ? Stroke::dashed : Stroke::solid});
  if (!chart.stacked)
    for (Series& series : chart.series) series.stroke = Stroke::solid;
  return chart.series.empty() ? "" : figure(chart);
}

std::string row_of(const std::string& name, const char* kind, double value, double whole) {
  const Scale scale = readable("J", whole);
  return fmt::format("<tr class=\"{}\"><th>{}</th><td>{} {}</td><td>{}</td></tr>", kind, escaped(name),
                     number(value * scale.factor), scale.unit, whole > 0 ? percent(value / whole) : "");
}

std::string table_of(const Curve& curve, const Account& account) {
  const std::size_t last = curve.table.rows() - 1;
  const double whole = turnover(account, curve.table.rows());
  std::string out =
      "<table class=\"numbers\"><thead><tr><th>at the end</th><th>energy</th><th>share</th></tr></thead><tbody>";
  for (const Column* column : account.input) out += row_of(column->name, "input", column->values[last], whole);
  for (const Column* column : account.stores) out += row_of(column->name, "store", column->values[last], whole);
  out += row_of("residual", "residual", residual_at(account, last), whole) + "</tbody></table>";
  double worst = 0;
  for (std::size_t row = 0; row <= last; ++row) worst = std::max(worst, std::abs(residual_at(account, row)));
  if (whole > 0)
    out += fmt::format("<p>Residual over the largest energy: <b>{}</b> at the end, {} at most during the run.</p>",
                       percent(std::abs(residual_at(account, last)) / whole), percent(worst / whole));
  return out;
}

}  // namespace

bool is_ledger(const Curve& curve) {
  return text_of(curve.sidecar, "kind", curve.name == "energy" ? "ledger" : "") == "ledger";
}

std::string ledger(const Run& run) {
  std::string body;
  for (const Curve& curve : run.curves) {
    if (!is_ledger(curve)) continue;
    const Account account = account_of(curve);
    if (account.input.empty() && account.stores.empty()) continue;
    body += "<div class=\"beside\">" + chart_of(curve, account) + "<div>" + table_of(curve, account) + "</div></div>";
  }
  const auto energy = run.summary.find("energy");
  if (body.empty() && energy != run.summary.end() && energy->is_object()) body = facts_table(*energy, "J");
  return section("Energy ledger", body);
}

}  // namespace beadwork::report
