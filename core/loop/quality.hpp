#pragma once
// How good a run is, by figures that its user would otherwise have to find in curves: whether the balance closes,
// whether it was slow enough, whether what is prescribed is in equilibrium, and whether something rolled away.
// docs/theory/quasi-static.md

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/domain/domain.hpp"
#include "core/domain/kept.hpp"

namespace beadwork {

/// What is seen of a run at one look.
struct QualityLook {
  Real stored = 0, kinetic = 0;  ///< [J]
  Real load = 0;                 ///< largest force of what is prescribed [N]
  Real imbalance = 0;            ///< largest sum of these forces along an axis [N]
  bool broken = false;           ///< something has broken by now
};

/// The figures; a share that nothing stands for is not a number.
struct QualityFigures {
  Real residual = 0;          ///< largest by which the balance failed to close, over the largest energy brought
  Real kinetic = 0;           ///< largest kinetic over stored energy at one look while loaded, until something breaks
  Real kinetic_cracking = 0;  ///< and from then on
  Real imbalance =
      0;  ///< largest sum of prescribed forces while loaded over the largest of them, until something breaks
  Real imbalance_cracking = 0;  ///< and from then on
  Real free_motion = 0;         ///< farthest that something undamaged moved as nothing holds it [m]
  Real free_motion_share =
      0;  ///< over the farthest prescribed displacement till then, or over the mean radius where there is none
  Real lost_at_breaks = 0;  ///< energy that breaks lost by the size of the step, over the largest energy brought
  bool dynamic = false;     ///< the deck prescribes nothing, or gives velocities: quasi-static limits do not apply
  bool at_rest = false;     ///< nothing has broken, and the last look found it in equilibrium
  bool unseen = false;      ///< no look found it loaded before something broke or the end
  bool idle = false;        ///< no energy was brought
  bool failed = false;      ///< the run was stopped by its physics, or by a plugin
};

/// What the figures amount to.
struct QualityVerdict {
  std::string
      /// good, fair, poor; dynamic where only the balance counts; not judged where there was nothing to see; idle
      word;
  std::vector<std::string> remarks;
};

namespace quality_limits {
/// The balance closes: 1e-3 is what the scheme itself leaves at usual steps; 2e-2 is beyond any use.
inline constexpr Real residual = 1e-3, residual_poor = 2e-2;
/// Quasi-static: explicit codes commonly ask for 5 to 10 %; a strength that is to be right within a percent asks for 1
/// % while nothing breaks.
inline constexpr Real kinetic = 0.01, kinetic_cracking = 0.05, kinetic_poor = 0.1;
/// What the size of the step takes from the motion that breaks set free is like a damping: as much as may fly while it
/// cracks.
inline constexpr Real lost_at_breaks = kinetic_cracking, lost_at_breaks_poor = 0.5;
/// Forces at both ends tell one and the same load.
inline constexpr Real imbalance = 0.02, imbalance_cracking = 0.05, imbalance_poor = 0.1;
/// Much of both looks like waves.
inline constexpr Real kinetic_waves = 0.2, imbalance_waves = 0.3;
/// A free motion that is a small part of the prescribed one changes little.
inline constexpr Real free_motion = 0.05, free_motion_poor = 0.5;
}  // namespace quality_limits

/// The largest of a figure over looks at which a body was loaded: with a tenth, more or less, of the largest stored
/// energy that there will have been in the end. Looks go by their stored energy into classes, a quarter of a decade
/// each, of which the highest few are kept.
class WorstLoaded {
 public:
  WorstLoaded() { none_ = 1; }
  /// Keeps its numbers in columns of this name of the scene, and in the list of its classes.
  WorstLoaded(Domain& domain, const std::string& name, const std::string& unit);
  void note(Real stored, Real figure) {
    if (!(stored > 0)) return;
    const Real of = std::floor(4 * std::log10(stored));
    if (none_ != 0 || of > top_) {
      const auto rise = none_ != 0 ? kept : static_cast<std::size_t>(std::min<Real>(of - top_, kept));
      for (std::size_t k = kept; k-- > 0;) worst_[k] = k >= rise ? Real(worst_[k - rise]) : 0;
      top_ = of;
      none_ = 0;
    }
    if (top_ - of < static_cast<Real>(kept)) {
      Kept& worst = worst_[static_cast<std::size_t>(top_ - of)];
      worst = std::max<Real>(worst, figure);
    }
  }
  Real worst() const { return *std::max_element(worst_.begin(), worst_.end()); }
  bool none() const { return none_ != 0; }  ///< no look was at anything stored

 private:
  static constexpr std::size_t kept = 4;
  Kept none_, top_;
  std::array<Kept, kept> worst_;
};

QualityVerdict judged(const QualityFigures& figures);
nlohmann::ordered_json quality_json(const QualityFigures& figures);

/// Gathers them, at looks every so many steps and in the step of the first break. Once what had broken carries, on the
/// mean over the steps from one look to the next, less than a tenth of the largest load, the test is over: pieces that
/// swing pull and push by turns, and tell nothing of it. It goes on when it is loaded anew: when a tenth of the largest
/// stored energy has been brought. A look after the first break counts only when the next one finds that it was not
/// over yet.
class Quality {
 public:
  Quality() = default;
  /// Keeps its numbers in the scene, for so many prescribed forces.
  Quality(Domain& domain, std::size_t forces);

  void look(const QualityLook& seen);
  /// Makes room for so many prescribed forces.
  void follow(std::size_t forces) { sums_.resize(std::max(forces, sums_.size())); }
  /// At every step: force(k) of `count` prescribed ones [N].
  template <class Force>
  void note_load(std::size_t count, const Force& force, bool broken) {
    for (std::size_t k = 0; k < count; ++k) {
      largest_load_ = std::max<Real>(largest_load_, std::abs(force(k)));
      if (broken) sums_[k] += force(k);
    }
    if (broken) steps_ += 1;
  }
  /// At the start of a stage: what was given to fly [J]. Forces are others from now on.
  void note_start(Real kinetic) {
    flown_ = std::max<Real>(flown_, kinetic);
    forget_load();
  }
  /// How far what nothing holds has moved, while what is prescribed has moved as far as `prescribed` [m].
  void note_free_motion(Real moved, Real prescribed) {
    free_motion_ = std::max<Real>(free_motion_, moved);
    prescribed_ = std::max<Real>(prescribed_, prescribed);
  }

  /// Fills in what was gathered here.
  void tell(QualityFigures& figures, Real mean_radius) const;
  Real flown() const { return flown_; }

 private:
  struct Cracking {
    Real kinetic, imbalance;
  };
  void look_sound(const QualityLook& seen);
  void heed_load(const QualityLook& seen);
  void settle();
  Real stored_by_now() const;
  Cracking cracking() const;
  Real mean_load() const;
  void forget_load() { std::fill(sums_.begin(), sums_.end(), 0), steps_ = 0; }

  Kept stored_, kinetic_, imbalance_, waits_;  // the last look that may count, while it waits
  Kept over_, slack_;                          // the test is over; the last look was at a moment of little load
  Kept lowest_energy_;                         // of the looks since it is over, or of the last look [J]
  std::vector<Kept> sums_;                     // of each prescribed force, over the steps since a look [N]
  Kept steps_;
  Kept largest_load_, largest_stored_, sound_load_;
  WorstLoaded sound_kinetic_, sound_imbalance_;  // ratios; sums of forces [N]
  Kept cracking_kinetic_, cracking_imbalance_;
  Kept free_motion_, prescribed_, flown_, at_rest_;
};

}  // namespace beadwork
