#pragma once
// The strength of a criterion: the same for all, or with the scatter of Weibull's law, drawn once for each bond or element.

#include <algorithm>
#include <numeric>
#include <vector>

#include "core/base/random.hpp"
#include "core/mechanics/weibull.hpp"
#include "core/plugin/failure.hpp"

namespace beadwork {

class ScatteredStrength {
 public:
  ScatteredStrength(Failure* criterion, const char* doc, On on)
      : strength_{criterion, {.name = "strength", .unit = "Pa", .range = positive, .doc = doc}},
        modulus_{criterion,
                 {.name = "weibull",
                  .range = {0.5, 1000},
                  .doc = "Weibull modulus of the strength: the smaller, the more it scatters about its mean, which is "
                         "'strength'; no scatter where absent",
                  .optional = true}},
        factor_{criterion, {"strength-factor", on, "1", "Strength over its mean"}} {
    factor_.own();
  }

  void choose() { factor_.want(modulus_.given()); }
  Real operator()(Index row) const { return factor_ ? *strength_ * factor_[row] : *strength_; }

  /// For the rows of a table, where that has not been done: in the order of the ids, so that how rows are stored changes
  /// nothing. Each criterion has a stream of its own for each family ("" for the elements).
  void draw(View<const Index> id, Index rows, std::uint64_t seed, const Failure& criterion, const std::string& family) {
    if (!factor_ || rows == 0 || factor_[0] > 0) return;
    std::vector<Index> order(static_cast<std::size_t>(rows));
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](Index a, Index b) { return id[a] < id[b]; });
    Random random(seed, stream_of(criterion.id() + "/" + family));
    for (const Index row : order) factor_[row] = weibull_factor(*modulus_, random.uniform());
  }

 private:
  Param<Real> strength_;
  Param<Real> modulus_;
  Keeps<Real> factor_;
};

}  // namespace beadwork
