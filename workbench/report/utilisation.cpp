// How near to breaking the run came: the largest utilisation of each criterion, and where.

#include <fmt/format.h>

#include <cmath>

#include "workbench/report/sections.hpp"
#include "workbench/report/text.hpp"

namespace beadwork::report {

namespace {

double real_of(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_number() ? found->get<double>() : std::nan("");
}

std::string list_of(const Json& object, const char* key, double factor) {
  std::string list;
  const auto found = object.find(key);
  if (found == object.end() || !found->is_array()) return list;
  for (const Json& value : *found)
    if (value.is_number()) list += (list.empty() ? "" : ", ") + number(factor * value.get<double>());
  return list;
}

/// Of a criterion on bonds a bond, of one on elements an element; "" where nothing was under load.
std::string whose(const Json& use) {
  if (use.contains("element")) return "element " + number(real_of(use, "element"), 9);
  if (!use.contains("bond")) return "";
  return fmt::format("bond {} between elements {}", number(real_of(use, "bond"), 9), list_of(use, "elements", 1));
}

std::string row(const Json& use) {
  const double largest = real_of(use, "largest"), time = real_of(use, "time");
  const Scale seconds = readable("s", std::isfinite(time) ? time : 0);
  double size = 0;
  if (const auto place = use.find("place"); place != use.end() && place->is_array())
    for (const Json& value : *place)
      if (value.is_number()) size = std::max(size, std::abs(value.get<double>()));
  const Scale metres = readable("m", size);
  std::string cells = fmt::format("<td>{}</td><td>{}</td><td>{}</td>", escaped(text_of(use, "of")),
                                  escaped(spaced(text_of(use, "mode"))), number(largest));
  const std::string that = whose(use);
  if (that.empty()) return "<tr>" + cells + "<td>nothing was under load</td></tr>";
  cells += fmt::format("<td>{}, at ({}) {}, step {}, {} {}</td>", that, list_of(use, "place", metres.factor),
                       metres.unit, number(real_of(use, "step"), 9), number(time * seconds.factor), seconds.unit);
  return "<tr>" + cells + "</tr>";
}

}  // namespace

std::string utilisation(const Run& run) {
  const auto uses = run.summary.find("utilisation");
  if (uses == run.summary.end() || !uses->is_object()) return "";
  std::string rows;
  for (const auto& [criterion, use] : uses->items())
    if (use.is_object()) rows += row(use);
  if (rows.empty()) return "";
  return section("Utilisation",
                 "<p>What each criterion has found over its strength, at its largest: from 1 on a bond breaks, "
                 "or an element loses its bonds.</p><table "
                 "class=\"facts\"><thead><tr><th>bonds</th><th>criterion</th><th>largest</th><th>where and "
                 "when</th></tr></thead><tbody>" +
                     rows + "</tbody></table>");
}

}  // namespace beadwork::report
