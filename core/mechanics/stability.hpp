#pragma once
// How long an explicit step may be. The limit of velocity Verlet is dt_c = 2/sqrt(lambda), lambda the largest
// eigenvalue of M^-1 K. docs/theory/time-step.md

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "core/mechanics/stiffness.hpp"

namespace beadwork {

/// The elastic bonds between elements, as far as a time step has to know them. A bond feels x2 - x1 and the
/// two rotations only, so that nine rows of its twelve say all; they are kept in single precision, 188 bytes
/// a bond.
class ElasticNetwork {
 public:
  explicit ElasticNetwork(Index elements) : elements_(elements) {}

  /// Room for so many bonds, each still to be `set`: by several threads where that helps.
  void resize(Index bonds);
  /// A bond with the stiffness (x1, theta1, x2, theta2) of beam_stiffness and its like.
  void set(Index bond, Index first, Index second, const Matrix12& stiffness);

  Index elements() const { return elements_; }
  Index bonds() const { return static_cast<Index>(ends_.size()); }
  Index first(Index bond) const { return ends_[static_cast<std::size_t>(bond)].first; }
  Index second(Index bond) const { return ends_[static_cast<std::size_t>(bond)].second; }
  Matrix12 stiffness(Index bond) const;
  /// Stiffness of a bond against displacement and against turning of each end, x1, theta1, x2, theta2: the
  /// measure by which masses are shared.
  std::array<Real, 4> grips(Index bond) const;
  /// For each element the sum of its bonds' grips: against displacement, against turning.
  std::vector<std::array<Real, 2>> total_grips() const;

  /// y = K x, six numbers an element (displacement, rotation). Sums each element's bonds in the order of their
  /// numbers, so that the bits do not depend on the number of threads.
  void multiply(std::span<const Real> x, std::span<Real> y) const;

 private:
  struct Ends {
    Index first, second;
  };
  struct Block {
    float lower[45];  // lower triangle by rows, order theta1, x2, theta2
  };

  void link() const;
  /// Calls visit(bond) for the bonds of an element, in the order of their numbers.
  template <class Visit>
  void visit_bonds(Index element, const Visit& visit) const;

  Index elements_;
  std::vector<Ends> ends_;
  std::vector<Block> blocks_;
  // element -> its bonds; made when first multiplied
  mutable std::vector<std::int64_t> start_;
  mutable std::vector<Index> links_;
};

/// What each element weighs in each of its six motions. Infinite, or zero inertia: it does not move that way
/// at all (held, or no rotation is integrated), and limits no step.
class Mobility {
 public:
  /// `inertia` may be empty: nothing rotates.
  Mobility(std::span<const Real> mass, std::span<const Real> inertia);

  /// Axis 0..2 displacement, 3..5 rotation.
  void hold(Index element, int axis) {
    inverse_[6 * static_cast<std::size_t>(element) + static_cast<std::size_t>(axis)] = 0;
  }
  Real inverse(Index element, int axis) const {
    return inverse_[6 * static_cast<std::size_t>(element) + static_cast<std::size_t>(axis)];
  }
  std::span<const Real> inverse() const { return inverse_; }

 private:
  std::vector<Real> inverse_;
};

/// The highest mode, or a bound of it, and where it sits.
struct HighestMode {
  Real lambda = 0;       ///< squared angular frequency [1/s^2]
  Index element = -1;    ///< where most of its kinetic energy is
  bool rotates = false;  ///< it turns there, rather than moves
  Real share = 0;        ///< of the kinetic energy, in that element
  Index bond = -1;       ///< the bond that limits, for the bound
};

/// y = K x for a network kept elsewhere.
using StiffnessProduct = std::function<void(std::span<const Real> x, std::span<Real> y)>;

/// By power iteration, from below: .98 of lambda after 40 rounds on a packing.
HighestMode power_iteration(const StiffnessProduct& product, const Mobility& mobility, int rounds = 40);
HighestMode power_iteration(const ElasticNetwork& network, const Mobility& mobility, int rounds = 40);

/// Never below lambda: the stiffest bond alone, each end's mass shared among its bonds in proportion to their
/// stiffness.
HighestMode bond_bound(const ElasticNetwork& network, const Mobility& mobility);

/// dt_c = 2/sqrt(lambda); infinite where nothing is stiff.
Real critical_step(Real lambda);

struct StableStep {
  Real dt;            ///< [s]; infinite where nothing is stiff
  Real lambda;        ///< what dt was made from: the smaller of 1.05 mode.lambda and bound.lambda [1/s^2]
  HighestMode mode;   ///< the estimate from below: names the element that limits
  HighestMode bound;  ///< the bound from above: names the bond
};

/// dt = safety * 2/sqrt(1.05 lambda_40): the estimate lies up to 2 % low on a packing, and by less than the
/// margin even if one stiff bond among millions should escape the start vector.
StableStep stable_step(const ElasticNetwork& network, const Mobility& mobility, Real safety = 0.9);

}  // namespace beadwork
