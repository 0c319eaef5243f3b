#pragma once
// The scene of a run as static solvers see it: its laws, its loads and what is prescribed, through what the loop lends.
//                                                                                             docs/theory/statics.md

#include <optional>

#include "core/domain/free_bodies.hpp"
#include "core/plugin/kinds.hpp"
#include "core/statics/static_model.hpp"
#include "core/statics/stiffness_matrix.hpp"

namespace beadwork {

/// What a static mover moves.
struct StaticRows {
  View<Vec3> place, velocity, force;
  View<Quat> orientation;  ///< with spin and torque: null where nothing turns
  View<Vec3> spin, torque;
  View<const Real> radius;
  View<Real> held;  ///< bits of the axes along and about which a free body is held where it is
};

class SceneModel final : public StaticModel {
 public:
  SceneModel(Workings& workings, const StaticRows& rows);

  const Supports& supports() const override { return supports_; }
  void begin_trial(Real time) override;
  Lacking lacking() const override;
  void move(const Vector& by) override;
  const Vector& forces() override;
  const SymmetricMatrix& stiffness(Slope slope) override;
  Vector force_rates() override;
  Lacking support_rates() const override;
  Vector moved() const override;
  Real work_on_the_way() override;
  Real time() const override { return w_.moment().time; }
  Real noise() const override { return noise_; }
  void pause() override { w_.pause(); }
  void give_up() override;

  /// Round-off of forces [N] and of energies [J], by the stiffness at the present state.
  struct Noise {
    Real force, energy;
  };
  Noise noise_here();
  /// Of forces, for as long as the stage lasts: a run that is resumed goes by the same.
  void take_noise(Real force) { noise_ = force; }
  /// Nothing moves yet.
  void stand_still();
  /// The trial state is accepted: laws note what they keep, what is prescribed tells its forces and its work.
  void accept();
  /// Forces at the state as it stands are those of the supports: where a run or a stage begins.
  void react(bool works);
  /// Supports as they follow from what hangs together now. Free bodies are held where they are if `pin`, else told.
  std::vector<FreeBody> support(bool pin);
  /// The same supports, after a restart: free bodies are held where they were.
  void support_as_before();
  /// By how much the bonds of a family that soften, or all, open or slide as they did in the last step: the mean, each with
  /// the weight of what it moved then, as a product with what elements move. Nothing if there is no such bond.
  std::optional<Vector> opening(const std::string& family, bool softening_only) const;
  /// The farthest that an element has gone since the last accepted state [m].
  Real farthest() const;
  /// The most that the mover's own pins and loose elements bear at the accepted state.
  struct Burden {
    Real force = 0;  ///< [N]
    Real share = 0;  ///< of all that supports take; 0 within round-off
    int unknown = -1;
  };
  Burden burden() const;
  /// Elements that nothing binds, which are held where they are.
  Index loose() const { return loose_; }
  /// The pairs that bonds and contacts make have changed since the stiffness got its pattern.
  bool has_other_pairs() const;
  /// The stiffness to be, with the pattern that these give it.
  const SymmetricMatrix& take_pairs();
  const SymmetricMatrix& pattern() const { return stiffness_.matrix(); }
  Index unknowns() const { return per_element() * count_; }
  Index element_of(int unknown) const { return unknown / per_element(); }
  /// In words, what an unknown is: "along x", "about z".
  std::string axis_of(int unknown) const;

 private:
  int per_element() const { return turning() ? 6 : 3; }
  bool turning() const { return static_cast<bool>(rows_.torque); }
  int unknown(Index element, int axis) const { return per_element() * element + axis; }
  Real unit(int axis) const { return axis < 3 ? 1 : length_; }
  Real add_opening(Index first, Index second, Vector& gradient) const;
  void note_accepted();
  void begin_support(const std::vector<Index>& body);
  void fix_prescribed();
  void fix_held();
  void fix_loose();
  void keep(int unknown);
  std::vector<char> pressed_elements() const;
  void collect_forces();
  void leave_unbalanced();
  void pin(const FreeBody& body);
  void pin_means();
  void choose_pins(const std::vector<Constraint*>& means, const std::vector<std::vector<int>>& choices);
  void lacking_body(const Constraint& c, std::size_t number, Vector& lack) const;
  Real gone(Index row, int axis) const;
  void react(Constraint& c, const Set& set, bool works);
  std::vector<const BondTable*> tables() const;
  std::vector<std::pair<Index, Index>> pairs() const;

  Workings& w_;
  StaticRows rows_;
  Index count_;
  Real length_ = 1;  ///< of the unknown of a turn of 1 rad: the mean radius [m]
  Real extent_ = 0;  ///< largest coordinate [m]
  Real accepted_time_ = 0;
  std::vector<Vec3> places_, turned_;  ///< of the accepted state; turned since [rad]
  std::vector<Quat> orientations_;
  std::vector<Set> sets_;         ///< of the constraints, without what has broken loose of a mean
  std::vector<int> mean_number_;  ///< of the constraints: which of the means of the supports; -1: none
  Supports supports_;
  StiffnessMatrix stiffness_;
  std::vector<std::pair<Index, Index>> pairs_;
  Vector forces_;
  Real noise_ = 0;  ///< [N]
  Index loose_ = 0;
};

}  // namespace beadwork
