#include "workbench/report/overlay.hpp"

#include "workbench/report/sections.hpp"
#include "workbench/report/text.hpp"

namespace beadwork::report {

void Overlay::add(const std::filesystem::path& folder, const std::string& label) {
  try {
    Run run = open_curves(folder);
    for (Curve& curve : run.curves) {
      if (is_ledger(curve)) continue;
      if (!by_name_.contains(curve.name)) names_.push_back(curve.name);
      curves_.push_back(std::move(curve));
      by_name_[curves_.back().name].emplace_back(label, &curves_.back());
    }
    for (const std::string& sentence : run.notes) note(label + ": " + sentence);
  } catch (const std::exception& failure) {
    note(label + ": " + failure.what());
  }
}

void Overlay::note(const std::string& sentence) { notes_ += "<li>" + escaped(sentence) + "</li>"; }

std::string Overlay::charts(const std::string& title) const {
  std::string charts;
  for (const std::string& name : names_) charts += overlaid(by_name_.at(name));
  return charts.empty() ? "" : section(title, "<div class=\"charts\">" + charts + "</div>");
}

std::string Overlay::chart(const std::string& name) const {
  const auto found = by_name_.find(name);
  return found == by_name_.end() ? "" : overlaid(found->second);
}

std::string Overlay::notes() const {
  return notes_.empty() ? "" : "<section class=\"notes\"><ul>" + notes_ + "</ul></section>\n";
}

}  // namespace beadwork::report
