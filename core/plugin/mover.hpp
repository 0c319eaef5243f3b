#pragma once
// Section <move>: advances the scene.

#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "core/base/log.hpp"
#include "core/domain/constraint.hpp"
#include "core/domain/moment.hpp"
#include "core/plugin/pair_law.hpp"

namespace beadwork {

/// What the loop lends to a mover.
class Workings {
 public:
  virtual ~Workings() = default;
  virtual Domain& domain() = 0;
  virtual Moment& moment() = 0;
  virtual std::vector<Constraint>& constraints() = 0;
  /// Sums of all forces and torques into the fields `force` and `torque`.
  virtual void evaluate(bool settle) = 0;
  /// The highest utilisation that the criteria of the stage find at the present state; 0 where there are none. Nothing
  /// breaks.
  virtual Real utilisation() = 0;
  /// The first moment up to this one, after the present, for which the stage or one of its watchers waits [s].
  virtual Real next_moment(Real until) const = 0;
  /// How far an element may move in a step without missing a contact [m]; infinite where nothing may touch.
  virtual Real reach() const = 0;
  /// To be called now and then in a step that may take long: throws Interrupted once the user has waited long enough for
  /// its end. The step is then lost.
  virtual void pause() = 0;
  /// The laws that act in this stage, each with its table.
  virtual std::span<const std::pair<PairLaw*, BondTable*>> laws() const = 0;
  virtual Log& log() = 0;
};

/// What falls, of all that reaches its threshold at one moment: everything, where inertia decides what comes of it, or
/// what has the highest utilisation, and the others are judged anew without it.
struct Breaks {
  std::size_t at_once = std::numeric_limits<std::size_t>::max();  ///< so many at most, the highest first
  Real within = std::numeric_limits<Real>::infinity();  ///< share by which the highest may exceed another that falls
};

/// A number that a mover has to tell of a run, for its summary.
struct MoverFigure {
  std::string name;
  Real value;
};

class Mover : public Plugin {
 public:
  static constexpr Kind its_kind = Kind::move;
  Mover() : Plugin(its_kind) {}
  Param<std::string> until{
      this,
      {.name = "until",
       .doc = "When the stage ends: a time (1 ms), a number of steps (5000), a displacement of what is pulled (0.8 "
              "mm), or a condition such as \"force of right < 2 percent of its maximum\" or \"sensor NAME > 3 MPa\"; "
              "several are joined by 'or'",
       .optional = true}};

  /// Told before anything is allocated: whether some plugin reads orientations or adds torques.
  virtual void choose_rotations(bool wanted) = 0;
  /// Complains of a stage that it cannot advance; `any_law`: bonds act in it.
  virtual void check_stage(const std::string& /*stage*/, bool /*any_law*/, Complaints&) const {}
  /// Before the first step of the stage: forces at the present state, time step. After a restart (`resumed`) both are
  /// what was kept.
  virtual void prepare(Workings& workings, bool resumed) = 0;
  /// One accepted step. Velocities and spins may be left behind, until somebody wants to see them.
  virtual void step(Workings& workings) = 0;
  /// Brings velocities and spins to the end of the step.
  virtual void complete(Workings&) {}
  virtual Breaks breaks() const { return {}; }
  /// What the run has taken, by the mover's own measures.
  virtual std::vector<MoverFigure> figures() const { return {}; }
  /// Whether bonds act in single precision, where their law can.
  virtual bool in_single() const { return false; }
  /// Energy by which the balance swings at the present state although nothing is wrong: what the scheme keeps is not
  /// the energy itself but the energy less this [J].
  virtual Real swing() const { return 0; }
  /// The part of it that follows from the present forces alone, and so jumps where something breaks [J].
  virtual Real shadow_energy() const { return 0; }
  /// What is probably wrong where the balance has an excess of energy that no work accounts for.
  virtual std::string suspect() const { return "a law's force is probably not the slope of its stored energy"; }
  /// For `plan`: what limits the time step.
  virtual std::string limited_by() const { return ""; }
};

}  // namespace beadwork
