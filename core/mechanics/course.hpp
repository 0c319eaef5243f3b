#pragma once
// Prescribed motion by any velocity over time. docs/theory/courses.md

#include <array>
#include <functional>
#include <mutex>
#include <vector>

#include "core/base/prescribed_motion.hpp"

namespace beadwork {

/// The place is the integral of the velocity from time 0 on, to rounding. It is summed over panels that the velocity
/// alone decides, so that a place at time t depends neither on the steps that led there nor on who asked before.
class VelocityCourse {
 public:
  using OfTime = std::function<Real(Real)>;
  /// The acceleration is the derivative of the velocity. `kinks`: times at which the velocity jumps or bends, as far as
  /// they are known. `noise`: how far rounding may take the velocity, over epsilon; where absent, that of the time alone.
  VelocityCourse(OfTime velocity, OfTime acceleration, std::vector<Real> kinks, OfTime noise = {});

  /// No number from the time on at which the velocity is none; before time 0 nothing has moved. Several threads may
  /// ask. Throws std::runtime_error if the velocity changes too often to be followed that far.
  PrescribedMotion at(Real t) const;

 private:
  struct Panel {
    Real begin, end;
  };
  struct Sum {
    Real value, way, noise;  ///< the integral; that of the speed; and what rounding may do to it, over epsilon
  };
  struct Known {
    Real time;
    PrescribedMotion motion;
  };

  PrescribedMotion found(Real t) const;
  void follow(Real t) const;
  void plan_next_octave() const;
  void divide(const Panel& octave) const;
  void settle(const Panel& panel) const;
  Real integral(const Panel& panel) const;
  Sum weighed(const Panel& panel) const;

  OfTime velocity_, acceleration_, noise_;
  std::vector<Real> kinks_;

  // What has been found so far, from time 0 on. All of it follows from the velocity.
  mutable std::mutex asked_;
  mutable std::vector<Real> ends_, travelled_;  ///< of the panels: their ends, and the place at these
  mutable std::vector<Panel> open_;             ///< panels still to be summed, the next one last
  mutable Real planned_ = 0;                    ///< end of the last octave
  mutable Real way_ = 0;                        ///< in all, forth and back
  mutable std::array<Known, 4> recent_;         ///< a step asks for few times, and for each of them often
  mutable std::size_t oldest_ = 0;
};

}  // namespace beadwork
