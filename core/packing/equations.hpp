#pragma once
// Contacts as equations in the positions and radii of the elements, and the smallest change that solves them.

#include <cstdint>
#include <vector>

#include "core/base/pause.hpp"
#include "core/packing/crowd.hpp"

namespace beadwork::packing {

/// A contact that is to become exact: dgap = n . (u_j - u_i) - dR_i - dR_j.
struct Contact {
  Index i;
  Index j;  ///< an element, or -1 - wall
  Vec3 n;   ///< from i to j; from i to the wall
  Real gap;
};

struct Change {
  Vec3 u;
  Real r;
};

/// How much of a gap may be left for a smaller change, relative to the diagonal: overlaps must go, open
/// contacts should close if nothing stands against it.
struct Damping {
  Real overlapping;
  Real open;
};

/// A, one row a contact, and its products. A change of radius costs 1/compliance as much as a move; 0 holds
/// it.
class ContactEquations {
 public:
  ContactEquations(std::size_t moving, const std::vector<Contact>&, const std::vector<Real>& compliance);

  /// The change with (A A^T + damping) lambda = -gap, change = A^T lambda, by conjugate gradients down to
  /// `reduction` of the first residual.
  void solve(const Damping&, Real reduction, int most, const Pause& pause = never_paused);

  const std::vector<Change>& change() const { return change_; }
  /// Gaps that the linear equations leave.
  std::vector<Real> remaining() const;

 private:
  bool moves(Index j) const { return j >= 0 && std::size_t(j) < moving_; }
  void list_terms();
  Real row_times_change(std::size_t e) const;
  template <class Multiplier>
  void scatter(const Multiplier& lambda);

  std::size_t moving_;
  const std::vector<Contact>& contact_;
  const std::vector<Real>& compliance_;
  std::vector<Change> change_;
  // The contacts of each element in fixed order: contact e as its i is e, as its j is -1 - e.
  std::vector<std::size_t> first_;
  std::vector<std::int32_t> term_;
};

}  // namespace beadwork::packing
