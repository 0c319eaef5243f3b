#include <fmt/format.h>

#include <cmath>

#include "core/base/failure.hpp"
#include "core/base/sums.hpp"
#include "core/domain/rows.hpp"
#include "core/domain/vocabulary.hpp"
#include "core/mechanics/verlet.hpp"
#include "core/plugin/kinds.hpp"
#include "plugins/move/dashpots.hpp"
#include "plugins/move/grips.hpp"
#include "plugins/move/stable_step.hpp"

namespace beadwork {

/// Velocity Verlet with numerical damping beta.   Eqs (1), (2); docs/theory/verlet.md
class Verlet final : public Mover {
 public:
  static constexpr const char* about = "Explicit dynamics: velocity Verlet with numerical damping beta, its time step found by itself";
  Param<Real> beta{this, {.name = "beta", .range = {0, 1, true, false}, .doc = "1: no damping; below 1 inertia grows by 1/beta and high frequencies are damped, Eq (2)", .fallback = "1"}};
  Param<Real> safety{this, {.name = "safety", .range = {0, 1, true, false}, .doc = "Time step over the estimate of the largest stable one", .fallback = "0.9"}};
  Param<Real> fixed_step{this, {.name = "time-step", .unit = "s", .range = positive, .doc = "Time step, instead of the one found by itself; a run that exceeds stability is stopped", .optional = true}};
  Param<Real> local_damping{this, {.name = "local-damping", .range = {0, 1, false, true}, .doc = "Share of each force component that is turned against the motion (Cundall)", .fallback = "0"}};
  Param<Real> bond_damping{this, {.name = "bond-damping", .range = {0, 1, false, true}, .doc = "Damping ratio of a pair of elements: dashpots beside each bond that holds, which keep both momenta", .fallback = "0"}};

  Keeps<Vec3> velocity{this, field::velocity};
  Keeps<Vec3> force{this, field::force};
  Keeps<Quat> orientation{this, field::orientation};
  Keeps<Vec3> spin{this, field::spin};
  Keeps<Vec3> torque{this, field::torque};
  Reads<Real> mass{this, field::mass};
  Reads<Real> inertia{this, field::inertia};
  Reads<Real> radius{this, field::radius};
  Keeps<Real> damped{this, {"damped", On::scene, "J", "Energy taken by damping"}};
  Keeps<Real> damping_power{this, {"damping-power", On::scene, "W", "Power that forces of damping took at the last step"}};
  Keeps<Real> stable{this, {"stable-step", On::scene, "s", "Largest stable step when the stage began"}};

  void choose_rotations(bool wanted) override {
    for (FieldUse* use : {static_cast<FieldUse*>(&orientation), static_cast<FieldUse*>(&spin), static_cast<FieldUse*>(&torque),
                          static_cast<FieldUse*>(&inertia)})
      use->want(wanted);
  }
  Real time_step() const override { return step_.time_step; }
  std::string limited_by() const override { return step_.by; }

  void prepare(Workings& w, bool resumed) override {
    count_ = w.domain().size();
    position_ = w.domain().elements().column("position").view<Vec3>();
    grips_ = Grips(w);
    if (*bond_damping > 0) dashpots_.prepare(w, *bond_damping, mass.view(), inertia.view(), resumed);
    if (!resumed) {
      step_ = largest_step(w);
      const Real largest = step_.time_step;
      w.moment().time_step = fixed_step.given() ? *fixed_step : *safety * largest;
      if (!std::isfinite(w.moment().time_step))
        refuse(at(), "nothing in this scene limits the time step: give 'time-step'");
      w.say(fmt::format("time step {:.4g} s, {:.3g} of the largest stable one; {}", w.moment().time_step, w.moment().time_step / largest,
                        step_.by));
      if (w.moment().time_step > largest)
        w.warn(fmt::format("{}: 'time-step' is {:.4g} s, the largest stable one {:.4g} s; a run that gains energy by it is stopped",
                           fixed_step.at().where(), w.moment().time_step, largest));
      stable[0] = largest;
      w.evaluate(false);
      grips_.seize(w, places(), turns(), *beta);
      damping_power[0] = damp(w) + dashpots_.power(velocity.view(), spin.view());
      grips_.react(w, places(), turns(), *beta);
    }
  }

  void step(Workings& w) override {
    Moment& now = w.moment();
    position_ = w.domain().elements().column("position").view<Vec3>();
    grips_.before_advance(w, position_);
    remember_rates();
    advance_all(now.time_step);
    grips_.after_advance(w, position_, mass.view());
    now.time += now.time_step;
    ++now.step;
    w.evaluate(true);
    const Real taken_by_local = damp(w);
    grips_.react(w, places(), turns(), *beta);
    correct_all(w);
    grips_.after_correct(w, places(), turns());
    book_beta();
    book_damping(now.time_step, taken_by_local + dashpots_.power(velocity.view(), spin.view()));
    if (now.step % 100 == 0) check_stability(w);
  }

  void energy(EnergySink& sink) const override {
    sink.kinetic(fixed_sum(count_, [&](Index i) {
                   Real twice = mass[i] * velocity[i].squaredNorm();
                   if (spin) twice += inertia[i] * spin[i].squaredNorm();
                   return 0.5 * twice;
                 }) /
                 *beta);
    if (*local_damping > 0 || *bond_damping > 0 || *beta < 1) sink.dissipated("damping", damped[0]);
  }

 private:
  Gripped places() const { return {velocity.view(), force.view(), mass.view()}; }
  Gripped turns() const { return {spin.view(), torque.view(), inertia.view()}; }

  // Local damping makes a force that slows down larger by its share, and so the stiffness that limits the step. Dashpots see
  // velocities of half a step ago, which limits it as a stiffness 2 C/dt would; dt falls towards the one that fits.
  StepLimit largest_step(Workings& w) const {
    const auto limit = [&](Real dt) {
      return step_limit(w, mass.view(), inertia.view(), [&](const BondTable& table, Index row, const Vec3& apart) -> Matrix12 {
        return std::isfinite(dt) ? dashpots_.stiffening(table, row, apart, dt) : Matrix12::Zero();
      });
    };
    StepLimit found = limit(std::numeric_limits<Real>::infinity());
    for (Real before = 0; dashpots_.any() && std::isfinite(found.time_step) && std::abs(found.time_step - before) > 1e-3 * found.time_step;) {
      before = found.time_step;
      found = limit(before);
    }
    found.time_step /= std::sqrt(1 + *local_damping);
    return found;
  }

  // Places and orientations at the next time; velocities half-way there.   Eq (1)
  void advance_all(Real dt) {
    const Real half = 0.5 * *beta * dt;
    rows::each(count_, [=, this, x = position_, v = velocity.view(), q = orientation.view(), w = spin.view(), f = force.view(),
                        t = torque.view(), m = mass.view(), inert = inertia.view()](const auto& at) {
      using T = typename std::decay_t<decltype(at)>::Number;
      const Vec<T> a = (T(1) / at(m)) * at(f);
      const Vec<T> before = at(v);
      at.set(x, advance<T>(at(x), before, a, T(dt)));
      at.set(v, before + T(half) * a);
      if (!w) return;
      const Vec<T> alpha = (T(1) / at(inert)) * at(t);
      const Vec<T> omega = at(w);
      at.set(q, turn<T>(at(q), omega, alpha, T(dt)));
      at.set(w, omega + T(half) * alpha);
    });
  }

  // Velocities from half-way to the full step.   Eq (2)
  void correct_all(Workings& w) {
    const Real half = 0.5 * *beta * w.moment().time_step;
    const bool broken = rows::any_of(count_, [=, v = velocity.view(), omega = spin.view(), f = force.view(), t = torque.view(),
                                              m = mass.view(), inert = inertia.view()](const auto& at) {
      using T = typename std::decay_t<decltype(at)>::Number;
      const Vec<T> push = at(f);
      T all = push[0] + push[1] + push[2];
      at.set(v, at(v) + (T(half) / at(m)) * push);
      if (omega) {
        const Vec<T> twist = at(t);
        all = all + twist[0] + twist[1] + twist[2];
        at.set(omega, at(omega) + (T(half) / at(inert)) * twist);
      }
      return !(all - all >= T(0));  // an infinity or what is no number
    });
    if (broken) stop_at_force(w);
  }

  // The kinetic energy after a step holds half of what the forces of this step do, and half of what those of the last one did.
  void book_damping(Real dt, Real power) {
    damped[0] += 0.5 * dt * (damping_power[0] + power);
    damping_power[0] = power;
  }

  // F -= alpha |F| sgn(v), component by component, where nothing prescribes the motion. Its power is that at the velocity of
  // full time, which the step is about to reach.
  template <class T>
  struct Damped {
    Vec<T> load;
    T power;
  };
  template <class T>
  [[gnu::always_inline]] static Damped<T> damp_one(const Vec<T>& load, const Vec<T>& rate, const T& inverse, Real share,
                                                   Real half, unsigned held = 0) {
    Damped<T> out{load, T(0)};
    for (int axis = 0; axis < 3; ++axis) {
      if (held >> axis & 1) continue;
      const T f = load[axis], v = rate[axis];
      const T size = select(f < T(0), -f, f);
      const T sense = select(v > T(0), T(1), select(v < T(0), T(-1), T(0)));
      const T d = (T(-share) * size) * sense;
      out.load[axis] = f + d;
      out.power = out.power - d * (v + T(half) * inverse * out.load[axis]);
    }
    return out;
  }
  // Both kinds of damping forces; the power of the local one [W].
  Real damp(Workings& w) {
    if (dashpots_.any()) dashpots_.act(w.domain(), force.view(), torque.view());
    if (*local_damping == 0) return 0;
    const Real half = 0.5 * *beta * w.moment().time_step;
    const Real share = *local_damping;
    return rows::sum(count_, [=, this, v = velocity.view(), omega = spin.view(), f = force.view(), t = torque.view(), m = mass.view(),
                              inert = inertia.view()]<class At>(const At& at) {
      using T = typename At::Number;
      const auto both = [&]<class Row>(const Row& row, unsigned held) {
        using N = typename Row::Number;
        const auto pushed = damp_one<N>(row(f), row(v), N(1) / row(m), share, half, held);
        row.set(f, pushed.load);
        if (!omega) return pushed.power;
        const auto turned = damp_one<N>(row(t), row(omega), N(1) / row(inert), share, half, held >> 3);
        row.set(t, turned.load);
        return N(pushed.power + turned.power);
      };
      if constexpr (At::count == 1) {
        return both(at, grips_.held(at.row));
      } else {
        if (!grips_.holds_any(at.row, At::count)) return both(at, 0);
        T power(0);
        for (int k = 0; k < At::count; ++k) power.v[k] = both(Rows<1>{at.row + k}, grips_.held(at.row + k));
        return power;
      }
    });
  }

  void remember_rates() {
    if (*beta == 1) return;
    before_.resize(static_cast<std::size_t>(count_) * 2);
    for (Index i = 0; i < count_; ++i) {
      before_[static_cast<std::size_t>(i) * 2] = velocity[i];
      if (spin) before_[static_cast<std::size_t>(i) * 2 + 1] = spin[i];
    }
  }

  // Beta below 1 takes (1 - beta)/(2 beta^2) m |v' - v|^2 a step.   docs/theory/verlet.md
  void book_beta() {
    if (*beta == 1) return;
    const auto change = [&](const View<Vec3>& rate, Index i, int first_axis) {
      const Vec3& before = before_[static_cast<std::size_t>(i) * 2 + static_cast<std::size_t>(first_axis / 3)];
      Real squared = 0;
      for (int axis = 0; axis < 3; ++axis)
        if (!grips_.holds(i, first_axis + axis)) squared += (rate.at(i, axis) - before[axis]) * (rate.at(i, axis) - before[axis]);
      return squared;
    };
    damped[0] += (1 - *beta) / (2 * *beta * *beta) * fixed_sum(count_, [&](Index i) {
                   Real squared = mass[i] * change(velocity.view(), i, 0);
                   if (spin) squared += inertia[i] * change(spin.view(), i, 3);
                   return squared;
                 });
  }

  [[noreturn]] void stop_at_force(Workings& w) {
    for (Index i = 0; i < count_; ++i)
      if (!force[i].allFinite() || (spin && !torque[i].allFinite()))
        throw PhysicsFailure(fmt::format("step {}: the force on element {} is not finite; {}", w.moment().step,
                                         w.domain().elements().column("id").view<Index>()[i], cause(w)));
    throw PhysicsFailure(fmt::format("step {}: forces are not finite; {}", w.moment().step, cause(w)));
  }

  // A run beyond stability ends here, whether its bonds still hold or have broken of it.
  void check_stability(Workings& w) const {
    if (!std::isfinite(stable[0])) return;  // nothing was bonded
    check_bonds(w);
    check_elements(w);
    if (w.moment().time_step > stable[0]) check_energy(w);
  }

  // In one step the ends of a bond may approach or part by a small share of its length only: faster is no solid any more.
  void check_bonds(Workings& w) const {
    const Real dt = w.moment().time_step;
    for (const auto& [law, table] : w.laws())
      for (const Chunk& chunk : table->chunks())
        for (Index b = chunk.begin; b < chunk.live_end; ++b) {
          const Index i = table->first()[b];
          const Index j = table->second()[b];
          const Real moved = (velocity[j] - velocity[i]).norm() * dt;
          const Real length = (position_[j] - position_[i]).norm();
          if (moved > 0.2 * length)
            stop(w, i, fmt::format("of a bond of '{}' moves by {:.2g} of the bond's length in one step", table->name(), moved / length));
        }
  }

  // Nor does an element pass by itself in one step.
  void check_elements(Workings& w) const {
    const Real dt = w.moment().time_step;
    for (Index i = 0; i < count_; ++i) {
      const Real moved = velocity[i].norm() * dt / radius[i];
      if (moved <= 1 && position_[i].allFinite()) continue;
      stop(w, i, std::isfinite(moved) ? fmt::format("moves by {:.2g} of its radius in one step", moved) : "has no finite place or velocity");
    }
  }

  // With too long a step bonds may break before anything is fast; what they were broken by is energy that nobody brought.
  void check_energy(Workings& w) const {
    EnergySums sums;
    w.energies(sums);
    const Real brought = std::abs(w.initial_energy()) + std::abs(sums.worked);
    const Real gained = sums.beyond_work() - w.initial_energy();
    if (gained <= brought) return;
    Index fastest = 0;
    for (Index i = 1; i < count_; ++i)
      if (velocity[i].squaredNorm() > velocity[fastest].squaredNorm()) fastest = i;
    stop(w, fastest, fmt::format("is the fastest of a run that has {:.4g} J more than the {:.4g} J that were brought to it", gained, brought));
  }

  [[noreturn]] void stop(Workings& w, Index element, const std::string& why) const {
    throw PhysicsFailure(fmt::format("step {}: element {} {}; {}", w.moment().step,
                                     w.domain().elements().column("id").view<Index>()[element], why, cause(w)));
  }

  std::string cause(Workings& w) const {
    const Real ratio = w.moment().time_step / stable[0];
    if (ratio > 1)
      return fmt::format("probable cause: the time step is {:.4g} times the largest stable one; leave 'time-step' out, or lower 'safety'", ratio);
    return fmt::format("the time step is {:.3g} of the largest stable one, so probably a load is too fast or a stiffness too high", ratio);
  }

  Index count_ = 0;
  View<Vec3> position_;
  Grips grips_;
  Dashpots dashpots_;
  std::vector<Vec3> before_;  // velocity and spin of each element when the step began, where beta is below 1
  StepLimit step_;
};

}  // namespace beadwork
