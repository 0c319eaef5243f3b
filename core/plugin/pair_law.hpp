#pragma once
// What acts between two elements, however the pair came about.

#include <limits>
#include <span>

#include "core/mechanics/stiffness.hpp"
#include "core/plugin/plugin.hpp"

namespace beadwork {

/// One evaluation of the forces.
struct Evaluation {
  bool clear = false;     ///< the first family of the evaluation overwrites the sums instead of adding
  bool settle = false;    ///< the state is accepted: write what is kept
  bool sections = false;  ///< somebody reads what the law offers of each bond (axial force, moments, ...)
  bool single = false;    ///< forces in single precision, of laws that can
  bool sums = false;      ///< somebody reads sums that the law offers (the virial), and this family counts in them
  Real time_step = 0;     ///< of the step whose end this is; 0 where none was made [s]
};

/// A bond that changed for good while settling.
struct BondEvent {
  Index row;
  std::string mode;  ///< under which its break is logged; "" of a change that is no break
  Real energy;       ///< [J]
};

class PairLaw : public Plugin {
 public:
  Param<std::string> name{
      this, {.name = "name", .doc = "Name of the family of bonds, or of the contacts", .role = Role::makes_family}};

  Param<std::vector<std::string>> between{
      this,
      {.name = "between",
       .doc = "The two sets between whose elements it acts; one and the same for pairs inside a set",
       .role = Role::set,
       .count = 2}};

  const std::string& family() const { return *name; }
  std::vector<std::string> families() const final { return {*name}; }

  /// Adds the forces of all live bonds to the elements: a pure function of the state and the accepted history.
  virtual void act(Domain& domain, BondTable& table, const Evaluation& evaluation) = 0;
  /// Takes the forces of one bond off the sums again: it has just broken, at this configuration.
  virtual void withdraw(Domain& domain, const BondTable& table, Index row) = 0;
  /// Bonds whose state changed while settling in the last `act`; empty at nearly all steps.
  virtual std::span<const BondEvent> events() const { return {}; }
  /// After such an event, once the step is complete: takes off the sums what acted in this step and acts no more from
  /// here on. A force that ended within a step would take half a step's work from the balance.
  virtual void end(Domain&, BondTable&, Index /*row*/) {}
  /// Recoverable energy of one bond [J].
  virtual Real stored_energy(const Domain& domain, const BondTable& table, Index row) const = 0;
  /// Sum over the live bonds, in a fixed order [J].
  virtual Real stored_energy(const Domain& domain, const BondTable& table) const = 0;
  /// Energy that the law itself has taken for good [J].
  virtual Real dissipated_energy(const Domain&, const BondTable&) const { return 0; }
  /// Stiffness of one bond: loads = -K moves, rows and columns (x1, theta1, x2, theta2), angles being increments seen
  /// from the world. Asked by several threads at once.
  virtual Matrix12 tangent(const Domain& domain, const BondTable& table, Index row, Slope slope) const = 0;
  /// True if the force depends on velocities, and on spins where it turns.
  virtual bool moves() const { return false; }
  /// How the force of such a law opposes velocities, beside the tangent: loads = -C rates, rates (v1, w1, v2, w2),
  /// symmetric. The largest that it can become: a time step must be stable for it. Asked by several threads at once.
  virtual Matrix12 damping(const Domain&, const BondTable&, Index) const { return Matrix12::Zero(); }
  /// Power that such forces take at the present velocities, over the live bonds [W].
  virtual Real power(const Domain&, const BondTable&) const { return 0; }
  /// True if the tangent has rotational parts.
  virtual bool turns() const { return true; }
  /// True if forces can be found in single precision.
  virtual bool can_be_single() const { return false; }
  /// True if broken bonds still act (a cohesive contact still resists closing): they stay among the live rows.
  virtual bool acts_when_broken() const { return false; }
  /// Longest step by which what it does is still resolved [s], beside the limit that its stiffness sets.
  virtual Real longest_step(const Domain&) const { return std::numeric_limits<Real>::infinity(); }
  /// What is probably wrong with it, at time steps of that length, where the balance has an excess of energy that no
  /// work accounts for; "" where nothing is.
  virtual std::string suspect(const Domain&, Real /*time_step*/) const { return ""; }
  /// True if the second of its pairs is a wall, on whose surface its forces act.
  virtual bool faces_walls() const { return false; }
  /// True if its forces are part of the stress of an element, where no deck says which families are.
  virtual bool is_in_stress() const { return true; }

 protected:
  explicit PairLaw(Kind kind) : Plugin(kind) {}
};

}  // namespace beadwork
