#pragma once
// Section <move>: advances the scene.

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
  /// The laws that act in this stage, each with its table.
  virtual std::span<const std::pair<PairLaw*, BondTable*>> laws() const = 0;
  virtual Log& log() = 0;
};

/// Of what reaches its threshold at one moment.
enum class Breaks {
  all,      ///< everything falls at once: inertia decides what comes of it
  highest,  ///< what has the highest utilisation alone: the others are judged anew without it
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
  virtual Breaks breaks() const { return Breaks::all; }
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
