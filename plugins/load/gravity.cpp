#include "core/base/parallel.hpp"
#include "core/base/sums.hpp"
#include "core/domain/vocabulary.hpp"
#include "core/plugin/kinds.hpp"
#include "plugins/load/factor.hpp"

namespace beadwork {

/// Weight: the mass of each element times an acceleration.
class Gravity final : public Load {
 public:
  static constexpr const char* about = "Weight of all elements, or of a set";
  Param<Vec3> acceleration{
      this,
      {.name = "acceleration", .unit = "m/s2", .doc = "Acceleration of free fall", .fallback = "0 0 -9.80665 m/s^2"}};
  Param<std::string> set{
      this,
      {.name = "set", .doc = "Set that has weight; all elements where absent", .optional = true, .role = Role::set}};
  Param<Formula> factor{this, factor_info("the weight is")};
  Adds<Vec3> force{this, field::force};
  Reads<Vec3> position{this, field::position};
  Reads<Real> mass{this, field::mass};
  Keeps<Real> work{this, {"work", On::scene, "J", "Work of the weight so far"}};
  Keeps<Real> fallen{this, {"fallen", On::scene, "J", "Sum of m g.(x - x at the start) at the last step"}};
  // Apart, lest what falls is lost in the digits of something far heavier that is held.
  Keeps<Vec3> from{this, {"fallen-from", On::elements, "m", "Place when the stage began"}};
  Keeps<Real> strong{this, {"strength", On::scene, "1", "Factor on the weight at the last step"}};
  Keeps<Real> began{this, {"began", On::scene, "s", "Time at which the weight began to act"}};
  Keeps<Real> begun{this, {"begun", On::scene, "1", "1 once it has begun"}};

  Gravity() { from.own(); }  // each from where it began

  void start(Domain& domain) override {
    for (Index row = 0; row < domain.size(); ++row) from.set(row, position[row]);
    fallen[0] = 0;
  }
  void push(Domain& domain, const Moment& moment) override {
    if (begun[0] == 0) began[0] = moment.time;
    begun[0] = 1;
    const Real strength = strength_at(moment);
    if (moment.step == moment.stage_step) strong[0] = strength;
    const Vec3 pull = strength * *acceleration;
    each(domain, [&](Index row) { force.add(row, mass[row] * pull); });
  }
  // The trapezoid over the way, which is what the scheme gives the motion.
  void account(const Domain& domain, const Moment& moment) override {
    const Real now = work_since_start(domain), before = strong[0];
    strong[0] = strength_at(moment);
    work[0] += 0.5 * (before + strong[0]) * (now - fallen[0]);
    fallen[0] = now;
  }
  void energy(EnergySink& sink) const override { sink.work("gravity", work[0]); }

 private:
  // A weight that stands in several stages begins once.
  Real strength_at(const Moment& moment) const { return factor_at(factor, moment.time - began[0]); }
  template <class F>
  void each(const Domain& domain, const F& f) const {
    if (!set.given()) return each_shared(domain.size(), f, 4096);
    for (const Index row : domain.set(*set)) f(row);
  }
  Real work_since_start(const Domain& domain) const {
    const auto term = [&](Index row) { return mass[row] * acceleration->dot(Vec3(position[row] - from[row])); };
    if (!set.given()) return fixed_sum(domain.size(), term);
    const Set& members = domain.set(*set);
    return fixed_sum(static_cast<Index>(members.size()),
                     [&](Index k) { return term(members[static_cast<std::size_t>(k)]); });
  }
};

}  // namespace beadwork
