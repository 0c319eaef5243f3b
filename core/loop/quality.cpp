#include "core/loop/quality.hpp"

#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>

namespace beadwork {

namespace {

constexpr Real loaded_from = 0.1;  // of the largest load, or of the largest stored energy
constexpr Real fewest_steps = 50;  // whose mean force tells swinging from carrying

Real share(Real part, Real whole) { return whole > 0 ? part / whole : 0; }

/// Collects what is beyond a limit, in words.
class Judge {
 public:
  void hold(Real figure, Real good, Real poor, const std::string& what) {
    if (!(figure > good)) return;
    worst_ = std::max(worst_, figure > poor ? 2 : 1);
    verdict_.remarks.push_back(fmt::format("{} is {:.2g} % (good: up to {:.2g} %)", what, 100 * figure, 100 * good));
  }
  void remark(const std::string& line) { verdict_.remarks.push_back(line); }
  QualityVerdict verdict(const std::string& at_best) {
    return worded(worst_ == 2 ? "poor" : worst_ == 1 ? "fair" : at_best);
  }
  QualityVerdict verdict_of_the_unseen() { return worded(worst_ == 2 ? "poor" : "not judged"); }

 private:
  QualityVerdict worded(const std::string& word) {
    verdict_.word = word;
    return verdict_;
  }

  int worst_ = 0;
  QualityVerdict verdict_;
};

}  // namespace

WorstLoaded::WorstLoaded(Domain& domain, const std::string& name, const std::string& unit)
    : none_(domain.scene(), "quality." + name + ".none", "1", "1 as long as no look was at anything stored"),
      top_(domain.scene(), "quality." + name + ".top", "1",
           "Highest class of stored energy, a quarter of a decade each") {
  Table& classes = domain.list("quality");
  classes.resize(static_cast<Index>(kept));
  for (std::size_t k = 0; k < kept; ++k)
    worst_[k].stand_in(classes, name, unit, "Largest of a figure over looks of a class of stored energy",
                       static_cast<Index>(k));
  none_ = 1;
}

Quality::Quality(Domain& domain, std::size_t forces)
    : sound_kinetic_(domain, "sound-kinetic", "1"), sound_imbalance_(domain, "sound-imbalance", "N") {
  const auto keep = [&](Kept& number, const char* name, const char* unit, const char* doc) {
    number.stand_in(domain.scene(), std::string("quality.") + name, unit, doc);
  };
  keep(stored_, "stored", "J", "Stored energy of the last look, while it waits");
  keep(kinetic_, "kinetic", "J", "Kinetic energy of the last look, while it waits");
  keep(imbalance_, "imbalance", "N", "Sum of prescribed forces of the last look, while it waits");
  keep(waits_, "waits", "1", "1 while the last look may yet count");
  keep(over_, "over", "1", "1 once what had broken carries no more");
  keep(slack_, "slack", "1", "1 if the last look was at a moment of little load");
  keep(lowest_energy_, "lowest-energy", "J", "Of the looks since it is over, or of the last look");
  keep(steps_, "steps", "1", "Steps over which prescribed forces are summed");
  keep(largest_load_, "largest-load", "N", "Largest prescribed force so far");
  keep(largest_stored_, "largest-stored", "J", "Largest stored energy so far");
  keep(sound_load_, "sound-load", "N", "Largest prescribed force until something breaks");
  keep(cracking_kinetic_, "cracking-kinetic", "1", "Largest kinetic over stored energy while it cracks");
  keep(cracking_imbalance_, "cracking-imbalance", "1",
       "Largest sum of prescribed forces over the largest of them while it cracks");
  keep(free_motion_, "free-motion", "m", "Farthest that something moved as nothing holds it");
  keep(prescribed_, "prescribed", "m", "Farthest prescribed displacement till then");
  keep(flown_, "flown", "J", "Largest kinetic energy that was given");
  keep(at_rest_, "at-rest", "1", "1 if the last look found equilibrium");
  Table& list = domain.list("prescribed-forces");
  list.resize(static_cast<Index>(forces));
  follow(forces);
  for (std::size_t k = 0; k < forces; ++k)
    sums_[k].stand_in(list, "sum", "N", "Sum over steps of a prescribed force", static_cast<Index>(k));
}

void Quality::look(const QualityLook& seen) {
  if (!seen.broken) return look_sound(seen);
  at_rest_ = 0;
  heed_load(seen);
  if (over_ != 0) {
    waits_ = 0;
    return;
  }
  slack_ = seen.load < loaded_from * largest_load_ ? 1 : 0;
  if (slack_ != 0) return;  // nothing to be seen at this moment; whether the test is over the next look tells
  settle();
  stored_ = seen.stored, kinetic_ = seen.kinetic, imbalance_ = seen.imbalance, waits_ = 1;
}

void Quality::look_sound(const QualityLook& seen) {
  largest_stored_ = std::max<Real>(largest_stored_, seen.stored);
  lowest_energy_ = seen.stored + seen.kinetic;
  sound_load_ = std::max<Real>(sound_load_, seen.load);
  sound_kinetic_.note(seen.stored, share(seen.kinetic, seen.stored));
  sound_imbalance_.note(seen.stored, seen.imbalance);
  at_rest_ = seen.stored > 0 && seen.kinetic <= quality_limits::kinetic * seen.stored &&
                     seen.imbalance <= quality_limits::imbalance * seen.load
                 ? 1
                 : 0;
}

// A single moment of little load ends nothing, and what swings does not begin anew by its swings: they bring no energy.
void Quality::heed_load(const QualityLook& seen) {
  const Real energy = seen.stored + seen.kinetic;
  const bool enough = steps_ >= fewest_steps;
  if (energy > lowest_energy_ + loaded_from * largest_stored_)
    over_ = 0;
  else if (enough && mean_load() < loaded_from * largest_load_)
    over_ = 1;
  lowest_energy_ = over_ != 0 ? std::min<Real>(lowest_energy_, energy) : energy;
  if (enough) forget_load();
}

Real Quality::mean_load() const {
  Real largest = 0;
  for (const Real sum : sums_) largest = std::max(largest, std::abs(sum));
  return largest / steps_;
}

// A look after the first break counts only when the next one finds that it was not over yet.
void Quality::settle() {
  if (waits_ == 0) return;
  const Cracking worst = cracking();
  cracking_kinetic_ = worst.kinetic, cracking_imbalance_ = worst.imbalance;
  largest_stored_ = stored_by_now();
  waits_ = 0;
}

Real Quality::stored_by_now() const { return std::max<Real>(largest_stored_, stored_); }

// With the look that waits.
Quality::Cracking Quality::cracking() const {
  Cracking worst{cracking_kinetic_, cracking_imbalance_};
  if (waits_ == 0 || stored_ < loaded_from * stored_by_now()) return worst;
  return {std::max(worst.kinetic, share(kinetic_, stored_)),
          std::max(worst.imbalance, share(imbalance_, largest_load_))};
}

void Quality::tell(QualityFigures& figures, Real mean_radius) const {
  const Cracking worst = slack_ == 0 ? cracking() : Cracking{cracking_kinetic_, cracking_imbalance_};
  figures.at_rest = at_rest_ != 0;
  figures.unseen = sound_kinetic_.none();
  figures.kinetic = sound_kinetic_.worst();
  figures.imbalance = share(sound_imbalance_.worst(), sound_load_);
  figures.kinetic_cracking = worst.kinetic;
  figures.imbalance_cracking = worst.imbalance;
  figures.free_motion = free_motion_;
  figures.free_motion_share = share(free_motion_, prescribed_ > 0 ? Real(prescribed_) : mean_radius);
}

QualityVerdict judged(const QualityFigures& f) {
  namespace limit = quality_limits;
  if (f.idle && !f.failed) return {"idle", {"no energy was brought to it: nothing to judge"}};
  Judge judge;
  judge.hold(f.residual, limit::residual, limit::residual_poor,
             "the residual of the energy balance over the largest work");
  judge.hold(f.lost_at_breaks, limit::lost_at_breaks, limit::lost_at_breaks_poor,
             "what breaks lost by the size of the step (lower 'safety') over the largest work");
  if (f.dynamic && !f.failed) return judge.verdict("dynamic");
  // What is elastic forgets the way to its equilibrium.
  const Real far = std::numeric_limits<Real>::infinity();
  judge.hold(f.kinetic, limit::kinetic, f.at_rest ? far : limit::kinetic_poor,
             "the largest kinetic over stored energy, before anything breaks,");
  judge.hold(f.kinetic_cracking, limit::kinetic_cracking, 5 * limit::kinetic_poor,
             "the largest kinetic over stored energy while it cracks");
  judge.hold(f.imbalance, limit::imbalance, f.at_rest ? far : limit::imbalance_poor,
             "the sum of the prescribed forces over the largest, before anything breaks,");
  judge.hold(f.imbalance_cracking, limit::imbalance_cracking, 5 * limit::imbalance_poor,
             "the sum of the prescribed forces over the largest while it cracks");
  judge.hold(f.free_motion_share, limit::free_motion, limit::free_motion_poor,
             fmt::format("a motion that nothing holds, {:.3g} m, over the prescribed one", f.free_motion));
  if (f.at_rest && (f.kinetic > limit::kinetic || f.imbalance > limit::imbalance))
    judge.remark("it came to rest: what is read at the end is in equilibrium, what is read on the way is not");
  else if (f.kinetic > limit::kinetic_waves && f.imbalance > limit::imbalance_waves)
    judge.remark(
        "that much of both before anything breaks looks like waves: as a slow test it is none, as a test of waves it "
        "is to be judged by their theory");
  if (!f.unseen && !f.failed) return judge.verdict("good");
  judge.remark(
      f.failed
          ? "the run failed, and what came last was not looked at"
          : "no look found it loaded before something broke or the run ended: whether it was slow enough is not known");
  return judge.verdict_of_the_unseen();
}

nlohmann::ordered_json quality_json(const QualityFigures& f) {
  const QualityVerdict verdict = judged(f);
  return {{"verdict", verdict.word},
          {"remarks", verdict.remarks},
          {"residual_over_work", f.residual},
          {"lost_at_breaks_over_work", f.lost_at_breaks},
          {"kinetic_over_stored", f.kinetic},
          {"kinetic_over_stored_cracking", f.kinetic_cracking},
          {"reactions_imbalance", f.imbalance},
          {"reactions_imbalance_cracking", f.imbalance_cracking},
          {"free_motion", f.free_motion},
          {"free_motion_over_prescribed", f.free_motion_share}};
}

}  // namespace beadwork
