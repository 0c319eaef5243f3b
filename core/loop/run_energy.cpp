#include <fmt/format.h>

#include <algorithm>

#include "core/loop/blame.hpp"
#include "core/loop/run.hpp"

namespace beadwork {

namespace {

// What the mover of another stage has damped counts; the elements' motion is told by the present one alone.
class WithoutKinetic final : public EnergySink {
 public:
  explicit WithoutKinetic(EnergySink& sink) : sink_(sink) {}
  void work(const std::string& by, Real joule) override { sink_.work(by, joule); }
  void stored(const std::string& in, Real joule) override { sink_.stored(in, joule); }
  void kinetic(Real) override {}
  void dissipated(const std::string& by, Real joule) override { sink_.dissipated(by, joule); }

 private:
  EnergySink& sink_;
};

}  // namespace

void Run::energies(EnergySink& sink) const {
  for (const auto& stage : constraints_)
    for (const Constraint& c : stage) sink.work(c.set, c.work);
  for (const auto& [law, table] : laws_) {
    blaming(*law, moment_, [&, law = law, table = table] {
      sink.stored(law->family(), law->stored_energy(*scene_.domain, *table));
      sink.dissipated(law->family(), law->dissipated_energy(*scene_.domain, *table));
    });
  }
  for (const auto& family : scene_.domain->families())
    if (const auto found = released_.find(family.get()); found != released_.end()) sink.dissipated(family->name(), found->second);
  WithoutKinetic earlier(sink);
  for (const auto& plugin : scene_.plugins) {
    const bool other_mover = dynamic_cast<const Mover*>(plugin.get()) && plugin.get() != &scene_.stages[stage_number()].mover();
    blaming(*plugin, moment_, [&] { plugin->energy(other_mover ? static_cast<EnergySink&>(earlier) : sink); });
  }
}

Real Run::beyond_work() const {
  EnergySums sums;
  energies(sums);
  return sums.beyond_work();
}

// A family that does not stand in the next stage pulls no longer: what its bonds hold is lost to the balance, and what they
// have dissipated stays booked.
void Run::let_go(const Stage& next) {
  std::erase_if(laws_, [&](const auto& acting) {
    const auto& [law, table] = acting;
    if (std::find(next.laws.begin(), next.laws.end(), law) != next.laws.end()) return false;
    const Real held = blaming(*law, moment_, [&, law = law, table = table] { return law->stored_energy(domain(), *table); });
    released_[table] += held + blaming(*law, moment_, [&, law = law, table = table] { return law->dissipated_energy(domain(), *table); });
    options_.say(fmt::format("bond family '{}' acts no longer: the {:.4g} J that it held are booked as dissipated", law->family(), held));
    return true;
  });
  left_at_stage_end_ = beyond_work();
}

// At the start of a stage: velocities that were given, and whatever else came without work.
void Run::count_brought() {
  initial_energy_ += beyond_work() - left_at_stage_end_;
}

}  // namespace beadwork
