#pragma once
// The stiffness that iterations go on with from one increment to the next. It stands in a list of the scene, so that a
// run that is resumed goes on with the same, and comes to the same bits.        docs/theory/statics.md

#include "core/domain/domain.hpp"
#include "core/statics/newton.hpp"

namespace beadwork {

class KeptStiffness {
 public:
  /// What of it is one number: iterations that it has served, and the sign of the supports that it was factored with.
  struct Rows {
    View<Real> served, supports;
  };
  KeptStiffness(Domain& domain, const Rows& rows) : list_(domain.list("stiffness")), rows_(rows) {}

  /// There is none yet, and room for one of this pattern.
  void begin(const SymmetricMatrix& pattern);
  /// After a restart: what was kept is factored again, for these supports.
  void resume(Newton& newton, const SymmetricMatrix& pattern, const Supports& supports);
  /// A stiffness that was factored for other supports serves no longer.
  void heed(Newton& newton, const Supports& supports) const;
  /// Notes what the step has left.
  void note(const Newton& newton, const SupportedSystem& system, const Supports& supports);

 private:
  View<Real> numbers();

  Table& list_;
  Rows rows_;
  std::int64_t noted_ = 0;  ///< factors that had been found when it was noted last
};

}  // namespace beadwork
