// How good the run is: a badge beside the name, and the figures behind it.

#include <fmt/format.h>

#include "core/loop/json_text.hpp"
#include "workbench/report/sections.hpp"
#include "workbench/report/text.hpp"

namespace beadwork::report {

namespace {

const Json* quality_of(const Run& run) {
  const auto found = run.summary.find("quality");
  return found != run.summary.end() && found->is_object() && !text_of(*found, "verdict").empty() ? &*found : nullptr;
}

/// The verdict in words; green is for "good" alone.
struct Word {
  const char* verdict;
  const char* badge;
  const char* colour;  ///< class of the badge
};
constexpr Word words[] = {{"good", "quasi-static, in balance", "done"},
                          {"fair", "see quality", "interrupted"},
                          {"poor", "poor quality", "failed"},
                          {"dynamic", "dynamic, in balance", "other"},
                          {"idle", "nothing was loaded", "other"}};

std::string row(const Json& quality, const char* key, const char* name, bool metres = false) {
  const auto found = quality.find(key);
  if (found == quality.end() || !found->is_number()) return "";
  const double value = found->get<double>();
  const Scale scale = readable("m", value);
  const std::string shown = metres ? number(value * scale.factor, 3) + " " + scale.unit : number(100 * value, 2) + " %";
  return fmt::format("<tr><th>{}</th><td>{}</td></tr>", name, shown);
}

}  // namespace

std::string quality_badge(const Run& run) {
  const Json* quality = quality_of(run);
  if (!quality) return "";
  const std::string verdict = text_of(*quality, "verdict");
  for (const Word& word : words)
    if (verdict == word.verdict) return fmt::format(" <span class=\"badge {}\">{}</span>", word.colour, word.badge);
  return " <span class=\"badge other\">" + escaped(verdict) + "</span>";
}

std::string quality(const Run& run) {
  const Json* found = quality_of(run);
  if (!found) return "";
  std::string remarks;
  for (const char* list : {"remarks", "free_bodies"}) {
    const auto entries = found->find(list);
    if (entries == found->end() || !entries->is_array()) continue;
    for (const Json& entry : *entries) {
      std::string said = entry.is_string() ? entry.get<std::string>() : "";
      if (entry.is_object() && entry.contains("elements") && entry.contains("free_to") && entry["free_to"].is_array()) {
        said = "a body of " + json_text(entry["elements"]) + " elements was free to";
        for (const Json& motion : entry["free_to"])
          said += (said.ends_with("to") ? " " : ", ") +
                  (motion.is_string() ? motion.get<std::string>() : json_text(motion));
      }
      if (!said.empty()) remarks += "<li>" + escaped(said) + "</li>";
    }
  }
  const std::string rows =
      row(*found, "residual_over_work", "residual of the energy balance over the largest work") +
      row(*found, "lost_at_breaks_over_work",
          "energy that breaks lost by the size of the step, over the largest work") +
      row(*found, "kinetic_over_stored", "kinetic over stored energy, before anything breaks") +
      row(*found, "kinetic_over_stored_cracking", "kinetic over stored energy, while it cracks") +
      row(*found, "reactions_imbalance", "prescribed forces out of balance, before anything breaks") +
      row(*found, "reactions_imbalance_cracking", "prescribed forces out of balance, while it cracks") +
      row(*found, "free_motion", "farthest motion that nothing holds", true);
  return section("Quality", "<table class=\"facts\"><tbody>" + rows + "</tbody></table>" +
                                (remarks.empty() ? "" : "<ul>" + remarks + "</ul>"));
}

}  // namespace beadwork::report
