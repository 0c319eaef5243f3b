#include "core/statics/kept_stiffness.hpp"

#include <algorithm>

namespace beadwork {

View<Real> KeptStiffness::numbers() {
  Column& column = list_.add({"value", On::scene, Type::real, "N/m", "Stiffness that is kept, its lower triangle", ""});
  column.keep();
  return column.view<Real>();
}

void KeptStiffness::begin(const SymmetricMatrix& pattern) {
  numbers();
  list_.resize(static_cast<Index>(pattern.value.size()));
  rows_.served[0] = Newton::no_factor;
}

void KeptStiffness::resume(Newton& newton, const SymmetricMatrix& pattern, const Supports& supports) {
  const bool fits = list_.size() == static_cast<Index>(pattern.value.size()) && rows_.supports[0] == supports.sign();
  if (rows_.served[0] == Newton::no_factor || !fits) return newton.forget_factor();
  SymmetricMatrix k = pattern;
  const View<Real> kept = numbers();
  for (std::size_t n = 0; n < k.value.size(); ++n) k.value[n] = kept[static_cast<Index>(n)];
  newton.take_factor(k, static_cast<int>(rows_.served[0]));
}

void KeptStiffness::heed(Newton& newton, const Supports& supports) const {
  if (newton.served() != Newton::no_factor && rows_.supports[0] != supports.sign()) newton.forget_factor();
}

void KeptStiffness::note(const Newton& newton, const SupportedSystem& system, const Supports& supports) {
  rows_.served[0] = newton.served();
  if (newton.served() == Newton::no_factor || newton.costs().factors == noted_) return;
  noted_ = newton.costs().factors;
  rows_.supports[0] = supports.sign();
  const std::vector<Real>& value = system.stiffness().value;
  if (list_.size() != static_cast<Index>(value.size())) list_.resize(static_cast<Index>(value.size()));
  const View<Real> kept = numbers();
  for (std::size_t n = 0; n < value.size(); ++n) kept[static_cast<Index>(n)] = value[n];
}

}  // namespace beadwork
