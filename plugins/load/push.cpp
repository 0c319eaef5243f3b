#include "core/domain/vocabulary.hpp"
#include "core/mechanics/ramp.hpp"
#include "core/plugin/kinds.hpp"
#include "plugins/load/factor.hpp"

namespace beadwork {

/// A force on a set, shared equally by its elements.
class Push final : public Load {
 public:
  static constexpr const char* about = "Puts a force on a set, shared equally by its elements";
  Param<std::string> set{this, {.name = "set", .doc = "Set that is pushed", .role = Role::set}};
  Param<Vec3> force{this, {.name = "force", .unit = "N", .doc = "Total force on the set", .fallback = "0 0 0 N"}};
  Param<Vec3> torque{this,
                     {.name = "torque",
                      .unit = "N.m",
                      .doc = "Total torque, shared equally as couples on the elements",
                      .fallback = "0 0 0 N.m"}};
  Param<Real> rise{this,
                   {.name = "rise",
                    .unit = "s",
                    .range = not_negative,
                    .doc = "Time over which the force sets in, smoothly",
                    .fallback = "0 s"}};
  Param<Formula> factor{this, factor_info("force and torque are")};

  Adds<Vec3> forces{this, field::force};
  Adds<Vec3> torques{this, field::torque};
  Reads<Vec3> position{this, field::position};
  Reads<Vec3> spin{this, field::spin};
  Keeps<Real> work{this, {"work", On::scene, "J", "Work of the force so far"}};
  Keeps<Vec3> place{this, {"place", On::scene, "m", "Mean place of the set at the last step"}};
  Keeps<Real> strong{this, {"strength", On::scene, "1", "Share of the force that acted at the last step"}};
  Keeps<Real> power{this, {"power", On::scene, "W", "Power of the torque at the last step"}};
  Keeps<Real> began{this, {"began", On::scene, "s", "Time at which it set in"}};
  Keeps<Real> begun{this, {"begun", On::scene, "1", "1 once it has set in"}};

  void choose() override {
    torques.want(torque->norm() > 0);
    spin.want(torque->norm() > 0);
  }

  void push(Domain& domain, const Moment& moment) override {
    if (begun[0] == 0) began[0] = moment.time;
    begun[0] = 1;
    if (moment.step == moment.stage_step) note(domain, moment);
    const Set& members = domain.set(*set);
    const Real share = strength(moment) / static_cast<Real>(members.size());
    for (const Index row : members) {
      forces.add(row, share * *force);
      if (torques) torques.add(row, share * *torque);
    }
  }

  // Of the force the trapezoid over the way of the places, which is what the scheme gives the motion; of the torque
  // that of the power.
  void account(const Domain& domain, const Moment& moment) override {
    const Vec3 from = place[0];
    const Real before = strong[0], power_before = power[0];
    note(domain, moment);
    work[0] +=
        0.5 * (before + strong[0]) * force->dot(place[0] - from) + 0.5 * (power_before + power[0]) * moment.time_step;
  }

  void energy(EnergySink& sink) const override { sink.work(*set, work[0]); }

 private:
  void note(const Domain& domain, const Moment& moment) {
    const Set& members = domain.set(*set);
    const auto count = static_cast<Real>(members.size());
    strong[0] = strength(moment);
    Vec3 sum = Vec3::Zero(), spins = Vec3::Zero();
    for (const Index row : members) {
      sum += position[row];
      if (spin) spins += spin[row];
    }
    place.set(0, sum / count);
    power[0] = strong[0] * torque->dot(spins) / count;
  }

  // A push that stands in several stages sets in once.
  Real strength(const Moment& moment) const {
    const Real since = moment.time - began[0];
    return (*rise > 0 ? smooth_step(since / *rise) : 1) * factor_at(factor, since);
  }
};

}  // namespace beadwork
