#include "core/domain/vocabulary.hpp"
#include "core/plugin/kinds.hpp"

namespace beadwork {

/// A force on a set, shared equally by its elements.
class Push final : public Load {
 public:
  static constexpr const char* about = "Puts a force on a set, shared equally by its elements";
  Param<std::string> set{this, {.name = "set", .doc = "Set that is pushed", .role = Role::set}};
  Param<Vec3> force{this, {.name = "force", .unit = "N", .doc = "Total force on the set", .fallback = "0 0 0 N"}};
  Param<Vec3> torque{this, {.name = "torque", .unit = "N.m", .doc = "Total torque, shared equally as couples on the elements", .fallback = "0 0 0 N.m"}};
  Param<Real> rise{this, {.name = "rise", .unit = "s", .range = not_negative, .doc = "Time over which the force sets in, smoothly", .fallback = "0 s"}};

  Adds<Vec3> forces{this, field::force};
  Adds<Vec3> torques{this, field::torque};
  Reads<Vec3> velocity{this, field::velocity};
  Reads<Vec3> spin{this, field::spin};
  Keeps<Real> work{this, {"work", On::scene, "J", "Work of the force so far"}};
  Keeps<Real> power{this, {"power", On::scene, "W", "Power at the last step"}};
  Keeps<Real> began{this, {"began", On::scene, "s", "Time at which it set in"}};
  Keeps<Real> begun{this, {"begun", On::scene, "1", "1 once it has set in"}};

  void choose() override {
    torques.want(torque->norm() > 0);
    spin.want(torque->norm() > 0);
  }

  void push(Domain& domain, const Moment& moment) override {
    if (begun[0] == 0) began[0] = moment.time;
    begun[0] = 1;
    if (moment.step == moment.stage_step) power[0] = power_now(domain, moment);
    const Set& members = domain.set(*set);
    const Real share = strength(moment) / static_cast<Real>(members.size());
    for (const Index row : members) {
      forces.add(row, share * *force);
      if (torques) torques.add(row, share * *torque);
    }
  }

  // The trapezoid of the power: of the order of the scheme itself.
  void account(const Domain& domain, const Moment& moment) override {
    const Real now = power_now(domain, moment);
    work[0] += 0.5 * (power[0] + now) * moment.time_step;
    power[0] = now;
  }

  void energy(EnergySink& sink) const override { sink.work(*set, work[0]); }

 private:
  Real power_now(const Domain& domain, const Moment& moment) const {
    const Set& members = domain.set(*set);
    const Real share = strength(moment) / static_cast<Real>(members.size());
    Real now = 0;
    for (const Index row : members) {
      now += share * force->dot(velocity[row]);
      if (spin) now += share * torque->dot(spin[row]);
    }
    return now;
  }

  // A push that stands in several stages sets in once.
  Real strength(const Moment& moment) const { return *rise > 0 ? smooth_step((moment.time - began[0]) / *rise) : 1; }
};

}  // namespace beadwork
