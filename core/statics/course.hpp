#pragma once
// The way of a scene from equilibrium to equilibrium: increments that are cut and grown, events, snap-backs.
//                                                                                             docs/theory/statics.md

#include <functional>
#include <optional>
#include <string>

#include "core/base/complaints.hpp"
#include "core/statics/increments.hpp"
#include "core/statics/kept_stiffness.hpp"
#include "core/statics/newton.hpp"
#include "core/statics/scene_model.hpp"

namespace beadwork {

/// What the deck says of it.
struct CourseChoices {
  Location at;  ///< of the mover, for what is refused
  NewtonLimits limits;
  std::string solver;
  bool pins_free = false;
  Real smallest = 0;            ///< share of an increment below which it is not cut any more
  Real within = 0;              ///< share by which what breaks first may exceed what breaks with it
  std::optional<Real> opening;  ///< of the bonds of a family, which is controlled while they soften [m]
  std::string opening_of;
  std::function<Real(Real share)> next_time;  ///< to which loads go by a share of an increment
};

/// Numbers of the scene that it remembers.
struct CourseRows {
  View<Real> share;                ///< of an increment, that is tried next
  View<Real> used;                 ///< highest utilisation at the last equilibrium
  View<Real> does;                 ///< most that an increment has changed of the forces [N]
  View<Real> released;             ///< by breaks, on the way to new equilibria [J]
  View<Real> noise, energy_noise;  ///< round-off of forces [N] and energies [J]
  View<Real> spent, cuts, carefully, events, worst, negative, borne;  ///< what it has taken, for the summary
};

class Course {
 public:
  Course(Workings& w, CourseChoices choices, const StaticRows& elements, const CourseRows& rows,
         const KeptStiffness::Rows& kept);

  void begin();
  /// After a restart: what was kept is taken up.
  void resume();
  /// One equilibrium more.
  void step();
  std::vector<MoverFigure> figures() const;

 private:
  Real analyse();
  void note_breaks(bool resumed);
  void hold();
  void heed_changes();
  void heed_burden();
  void heed_rounding();
  bool is_out_of_balance();
  void settle();
  void advance();
  bool advance_by_opening(IncrementShare& tried, bool softening_only);
  void stop_at_event(Real from, Real to, NewtonResult& result);
  NewtonResult go(Real to);
  NewtonResult within_reach(NewtonResult result) const;
  void warn(const NewtonResult& result);
  void note_cut(const IncrementShare& tried, const NewtonResult& result);
  std::string told(const NewtonResult& result) const;
  [[noreturn]] void fail(const NewtonResult& result, Real step);

  Workings& w_;
  CourseChoices choices_;
  CourseRows rows_;
  SceneModel model_;
  SupportedSystem system_;
  Newton newton_;
  KeptStiffness kept_;
  std::size_t seen_breaks_ = 0;
  bool broke_ = false;
};

}  // namespace beadwork
