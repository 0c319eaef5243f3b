#include "core/loop/quality.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace beadwork {

namespace {

Real share(Real part, Real whole) { return whole > 0 ? part / whole : 0; }

/// Collects what is beyond a limit, in words.
class Judge {
 public:
  void hold(Real figure, Real good, Real poor, const std::string& what) {
    if (!(figure > good)) return;
    worst_ = std::max(worst_, figure > poor ? 2 : 1);
    verdict_.remarks.push_back(fmt::format("{} is {:.2g} % (good: up to {:.2g} %)", what, 100 * figure, 100 * good));
  }
  QualityVerdict verdict(bool dynamic) {
    verdict_.word = worst_ == 2 ? "poor" : worst_ == 1 ? "fair" : dynamic ? "dynamic" : "good";
    return verdict_;
  }

 private:
  int worst_ = 0;
  QualityVerdict verdict_;
};

}  // namespace

void Quality::settle() {
  if (waits_ == 0) return;
  waits_ = 0;
  largest_stored_ = std::max(largest_stored_, stored_);
  if (broken_ == 0) {
    sound_load_ = std::max(sound_load_, load_);
    sound_kinetic_.note(stored_, share(kinetic_, stored_));
    sound_imbalance_.note(stored_, imbalance_);
  } else if (stored_ >= 0.1 * largest_stored_) {
    cracking_kinetic_ = std::max(cracking_kinetic_, share(kinetic_, stored_));
    cracking_imbalance_ = std::max(cracking_imbalance_, share(imbalance_, largest_load_));
  }
}

void Quality::tell(QualityFigures& figures) const {
  Quality whole = *this;
  whole.settle();
  figures.kinetic = whole.sound_kinetic_.worst();
  figures.imbalance = share(whole.sound_imbalance_.worst(), whole.sound_load_);
  figures.kinetic_cracking = whole.cracking_kinetic_;
  figures.imbalance_cracking = whole.cracking_imbalance_;
  figures.free_motion = free_motion_;
  figures.free_motion_share = free_share_;
}

QualityVerdict judged(const QualityFigures& f) {
  namespace limit = quality_limits;
  if (f.idle) return {"idle", {"no energy was brought to it: nothing to judge"}};
  Judge judge;
  judge.hold(f.residual, limit::residual, limit::residual_poor, "the residual of the energy balance over the largest work");
  if (f.dynamic) return judge.verdict(true);
  if (f.kinetic > limit::kinetic_waves && f.imbalance > limit::imbalance_waves) {
    QualityVerdict waves = judge.verdict(true);
    waves.remarks.push_back(fmt::format("before anything breaks, the kinetic energy is up to {:.2g} % of the stored one, and prescribed forces are {:.2g} % out of "
                                        "balance: waves, and no slow test",
                                        100 * f.kinetic, 100 * f.imbalance));
    return waves;
  }
  judge.hold(f.kinetic, limit::kinetic, limit::kinetic_poor, "the largest kinetic over stored energy, before anything breaks,");
  judge.hold(f.kinetic_cracking, limit::kinetic_cracking, 5 * limit::kinetic_poor, "the largest kinetic over stored energy while it cracks");
  judge.hold(f.imbalance, limit::imbalance, limit::imbalance_poor, "the sum of the prescribed forces over the largest, before anything breaks,");
  judge.hold(f.imbalance_cracking, limit::imbalance_cracking, 5 * limit::imbalance_poor, "the sum of the prescribed forces over the largest while it cracks");
  judge.hold(f.free_motion_share, limit::free_motion, limit::free_motion_poor, fmt::format("a motion that nothing holds, {:.3g} m, over the prescribed one", f.free_motion));
  return judge.verdict(false);
}

nlohmann::ordered_json quality_json(const QualityFigures& f) {
  const QualityVerdict verdict = judged(f);
  return {{"verdict", verdict.word},
          {"remarks", verdict.remarks},
          {"residual_over_work", f.residual},
          {"kinetic_over_stored", f.kinetic},
          {"kinetic_over_stored_cracking", f.kinetic_cracking},
          {"reactions_imbalance", f.imbalance},
          {"reactions_imbalance_cracking", f.imbalance_cracking},
          {"free_motion", f.free_motion},
          {"free_motion_over_prescribed", f.free_motion_share}};
}

}  // namespace beadwork
