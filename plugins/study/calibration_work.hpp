#pragma once
// The steps of a calibration, each of which runs scenes and adds to what has been found.   docs/theory/calibration.md

#include <algorithm>
#include <limits>
#include <numeric>

#include "core/base/failure.hpp"
#include "plugins/study/calibration_results.hpp"
#include "plugins/study/mechanical_tests.hpp"
#include "plugins/study/pulls.hpp"
#include "plugins/study/strength_tests.hpp"

namespace beadwork::calibration {

class Work {
 public:
  Work(const Plan& plan, const StudyDesk& desk, const Location& poisson_at)
      : plan_(plan), pulls_(plan, desk.folder, plan.decks.by), desk_(desk), poisson_at_(poisson_at) {}

  Found all() {
    desk_.write("size.xml", size_deck(plan_.decks));
    pack();
    desk_.write("sample.xml", sample_deck(plan_.decks, found_.packings.front().file));
    desk_.write("pulled.xml", pulled_deck(plan_.decks));
    desk_.write("elastic.xml", elastic_deck(plan_.decks.by));
    found_.curves.resize(found_.packings.size());
    measure(plan_.ratios);
    find_ratio();
    find_young();
    look_along_other_axes();
    MechanicalTests tests(plan_, desk_, found_);
    found_.tested = tests.all();
    found_.line = tests.line();
    for (const std::string& line : test_lines(plan_, found_.tested)) desk_.log.say(line);
    if (plan_.material.strength) found_.strengths = StrengthTests(plan_, desk_, found_).all();
    return found_;
  }

 private:
  static constexpr Real close_ = 1e-3;  // of Poisson's ratio to the target

  // --- samples ------------------------------------------------------------------------------------------------------

  void pack() {
    const auto deck = desk_.write("packing.xml", packing_deck(plan_.decks));
    std::vector<Errand> errands;
    for (std::int64_t k = 0; k < plan_.seeds; ++k) {
      const std::string seed = std::to_string(plan_.first_seed + k);
      errands.push_back({"packing,seed=" + seed, deck, {{"seed", seed}}});
    }
    const std::vector<Outcome> outcomes = desk_.runner.run(errands);
    for (std::size_t k = 0; k < outcomes.size(); ++k) {
      const Outcome& one = outcomes[k];
      if (!one.is_done()) throw PhysicsFailure(fmt::format("error: {}: {}", errands[k].name, one.reason));
      const auto last = [&](const char* name) { return last_step(one, name); };
      found_.packings.push_back({plan_.first_seed + static_cast<std::int64_t>(k),
                                 (one.folder / "run.h5").lexically_relative(desk_.folder).string(),
                                 last("coordination"), last("coordination_bulk"), last("density_bulk"),
                                 last("fabric_eigenvalues/0"), last("fabric_eigenvalues/2")});
    }
    desk_.log.say(fmt::format("{} samples of {} elements: coordination {}, {} in the bulk; density {}", plan_.seeds,
                              plan_.decks.elements, spread_text(each(found_.packings, &Packed::coordination)),
                              spread_text(each(found_.packings, &Packed::coordination_bulk)),
                              spread_text(each(found_.packings, &Packed::density_bulk))));
  }

  // Of the last step of the filling that tells it.
  static Real last_step(const Outcome& outcome, const std::string& name) {
    Real value = std::numeric_limits<Real>::quiet_NaN();
    for (int step = 0; outcome.numbers.contains(fmt::format("packing/{}/elements", step)); ++step)
      value = outcome.number(fmt::format("packing/{}/{}", step, name));
    return value;
  }

  // --- elastic ------------------------------------------------------------------------------------------------------

  Real guessed_young(const Packed& packing, Real ratio) const {
    const Real guess = stiffness_ratio({packing.coordination_bulk, packing.density_bulk, ratio},
                                       std::min(plan_.material.poisson, Real(0.45)));
    return rounded(plan_.material.young / guess, significant);
  }

  std::string first_axis() const { return calibration::first_axis(plan_.decks); }

  void warn_left_out(const Errand& errand, const Outcome& outcome) const {
    desk_.log.warn(fmt::format("{} is left out: {}", errand.name, outcome.reason));
  }

  // All samples at each of these ratios.
  void measure(const std::vector<Real>& ratios) {
    std::vector<Errand> errands;
    std::vector<std::pair<std::size_t, Real>> of;  // sample and ratio
    for (const Real ratio : ratios)
      for (std::size_t k = 0; k < found_.packings.size(); ++k) {
        const Packed& packing = found_.packings[k];
        errands.push_back(pulls_.errand(packing, {ratio, guessed_young(packing, ratio), first_axis()}));
        of.emplace_back(k, ratio);
      }
    const std::vector<Outcome> outcomes = desk_.runner.run(errands);
    for (std::size_t k = 0; k < outcomes.size(); ++k) {
      const auto [sample, ratio] = of[k];
      const Elastic one = pulls_.read(outcomes[k], first_axis(), guessed_young(found_.packings[sample], ratio));
      if (!outcomes[k].is_done() || !std::isfinite(one.poisson) || !std::isfinite(one.centres)) {
        warn_left_out(errands[k], outcomes[k]);
        continue;
      }
      found_.curves[sample].poisson.note(ratio, one.poisson);
      found_.curves[sample].stiffness.note(ratio, modulus_of(plan_, one));
      elastic_[{sample, ratio}] = one;
    }
    for (const Real ratio : ratios) tell(ratio);
  }

  std::vector<Elastic> at(Real ratio) const {
    std::vector<Elastic> all;
    for (std::size_t k = 0; k < found_.packings.size(); ++k)
      if (const auto one = elastic_.find({k, ratio}); one != elastic_.end()) all.push_back(one->second);
    return all;
  }

  void tell(Real ratio) const {
    const std::vector<Elastic> all = at(ratio);
    if (all.empty()) return;
    desk_.log.say(fmt::format("radius ratio {:<8} Poisson's ratio {}, E over that of the bonds {}",
                              format_number(ratio), spread_text(each(all, &Elastic::poisson)),
                              spread_text(moduli_of(plan_, all))));
  }

  // --- inversion ----------------------------------------------------------------------------------------------------

  // Mean over the samples.
  Response mean_poisson() const {
    Response mean;
    for (const auto& [key, one] : elastic_) {
      const std::vector<Elastic> all = at(key.second);
      if (all.size() == found_.packings.size()) mean.note(key.second, scatter_of(each(all, &Elastic::poisson)).mean);
    }
    return mean;
  }

  void find_ratio() {
    const Real wanted = plan_.material.poisson;
    constexpr int rounds = 6;
    for (int round = 0; round < rounds; ++round) {
      const Response poisson = mean_poisson();
      if (poisson.is_empty()) throw PhysicsFailure("error: at no radius ratio all samples came to their end");
      const auto ratio = poisson.where(wanted);
      if (!ratio) refuse_target(poisson);
      found_.ratio = rounded(*ratio, significant);
      if (at(found_.ratio).size() < found_.packings.size()) measure({found_.ratio});
      const std::vector<Elastic> now = at(found_.ratio);
      if (now.empty())
        throw PhysicsFailure("error: no elastic sample came to its end at the radius ratio that was found");
      if (std::abs(scatter_of(each(now, &Elastic::poisson)).mean - wanted) < close_) break;
    }
    found_.elastic = at(found_.ratio);
    const Real reached = scatter_of(each(found_.elastic, &Elastic::poisson)).mean;
    if (!(std::abs(reached - wanted) < close_))
      desk_.log.warn(fmt::format("at the radius ratio that was found Poisson's ratio is {:.4g}, where {} is wanted",
                                 reached, format_number(wanted)));
    for (const Curves& curves : found_.curves)
      if (const auto own = curves.poisson.where(wanted)) found_.ratios.push_back(*own);
    desk_.log.say(fmt::format("found: radius ratio {}, by each sample {}", format_number(found_.ratio),
                              found_.ratios.empty() ? "none" : spread_text(found_.ratios)));
  }

  [[noreturn]] void refuse_target(const Response& poisson) const {
    const auto& points = poisson.points();
    const Response::Span span = poisson.range();
    refuse(
        poisson_at_,
        fmt::format("a Poisson's ratio of {} is out of reach: with {} elements it goes from {:.3g} to {:.3g} between "
                    "the radius ratios {} and {}; 'radius-ratios' can widen that, a lattice or another law of bonds "
                    "change it (docs/theory/calibration.md)",
                    format_number(plan_.material.poisson), plan_.decks.elements, span.low, span.high,
                    format_number(points.begin()->first), format_number(points.rbegin()->first)));
  }

  // E of the solid is proportional to that of the bonds.
  void find_young() {
    found_.young = rounded(plan_.material.young / scatter_of(moduli_of(plan_, found_.elastic)).mean, significant);
    desk_.log.say(
        fmt::format("found: E of the bonds {:.4g} GPa, {} times that of the solid ({} over the whole section, "
                    "{} by the virial of the core)",
                    1e-9 * found_.young, format_number(rounded(found_.young / plan_.material.young, significant)),
                    inverse_text(&Elastic::box), inverse_text(&Elastic::virial)));
  }
  std::string inverse_text(Real Elastic::*modulus) const {
    return format_number(rounded(1 / scatter_of(each(found_.elastic, modulus)).mean, significant));
  }

  void look_along_other_axes() {
    found_.along[first_axis()] = found_.elastic;
    if (plan_.decks.is_cylinder) return;
    std::vector<Errand> errands;
    for (const char* axis : {"y", "z"})
      for (const Packed& packing : found_.packings)
        errands.push_back(pulls_.errand(packing, {found_.ratio, found_.young, axis}));
    const std::vector<Outcome> outcomes = desk_.runner.run(errands);
    for (std::size_t k = 0; k < outcomes.size(); ++k) {
      const std::string axis = k < found_.packings.size() ? "y" : "z";
      if (outcomes[k].is_done())
        found_.along[axis].push_back(pulls_.read(outcomes[k], axis, found_.young));
      else
        warn_left_out(errands[k], outcomes[k]);
    }
    for (const auto& [axis, all] : found_.along)
      desk_.log.say(fmt::format("along {}: E {} GPa, Poisson's ratio {}", axis,
                                spread_text(scaled(moduli_of(plan_, all), 1e-9 * found_.young)),
                                spread_text(each(all, &Elastic::poisson))));
  }
  static std::vector<Real> scaled(std::vector<Real> values, Real factor) {
    for (Real& value : values) value *= factor;
    return values;
  }

  const Plan& plan_;
  Pulls pulls_;
  const StudyDesk& desk_;
  Location poisson_at_;
  Found found_;
  std::map<std::pair<std::size_t, Real>, Elastic> elastic_;  ///< by sample and radius ratio
};

}  // namespace beadwork::calibration
