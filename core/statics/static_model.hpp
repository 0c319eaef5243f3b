#pragma once
// What a static solver asks of a scene, and what it tells it: all solvers share it, and know no more.

#include "core/mechanics/stiffness.hpp"
#include "core/statics/supports.hpp"

namespace beadwork {

class StaticModel {
 public:
  virtual ~StaticModel() = default;
  virtual const Supports& supports() const = 0;
  /// A trial begins, from the last accepted state: loads and what is prescribed are those of this time.
  virtual void begin_trial(Real time) = 0;
  /// What the supports have to move until the trial state is where it is prescribed to be.
  virtual Lacking lacking() const = 0;
  /// Moves the trial state: turns are composed, never added.
  virtual void move(const Vector& by) = 0;
  /// Forces at the trial state that nothing balances, and of supports what they have to take [N].
  virtual const Vector& forces() = 0;
  /// K at the trial state: of the forces the slope, less than nothing [N/m].
  virtual const SymmetricMatrix& stiffness(Slope slope) = 0;
  /// By how much, over a second, loads push more, and supports move on, at the time of the trial.
  virtual Vector force_rates() = 0;
  virtual Lacking support_rates() const = 0;
  /// What the trial state has moved since the last accepted one.
  virtual Vector moved() const = 0;
  /// What forces that nothing balances do along the straight way from the last accepted state to the trial state, at the
  /// loads of the trial; it stays as it is. In a small increment they fall to nothing on the way; where something snaps they
  /// do more than the increment itself, and that would become motion [J].
  virtual Real work_on_the_way() = 0;
  /// Of the trial; between two trials that of the last accepted state.
  virtual Real time() const = 0;
  /// Forces smaller than this are round-off [N].
  virtual Real noise() const = 0;
  /// Called once an iteration; what it throws ends the search.
  virtual void pause() {}
  /// Back to the last accepted state.
  virtual void give_up() = 0;
};

}  // namespace beadwork
