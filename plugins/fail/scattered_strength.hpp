#pragma once
// The strength of a criterion: the same for all, or with the scatter of Weibull's law, drawn once for each bond or element.

#include <algorithm>
#include <vector>

#include "core/base/random.hpp"
#include "core/base/text.hpp"
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

  /// In the order of the ids, so that how rows are stored changes nothing; each criterion has a stream of its own.
  void draw(View<const Index> id, Index rows, Random& random) {
    if (!factor_) return;
    std::vector<Index> order(static_cast<std::size_t>(rows));
    for (Index row = 0; row < rows; ++row) order[static_cast<std::size_t>(row)] = row;
    std::sort(order.begin(), order.end(), [&](Index a, Index b) { return id[a] < id[b]; });
    for (const Index row : order) factor_[row] = weibull_factor(*modulus_, random.uniform());
  }

  /// "fail.bond-stress.2" draws other numbers than "fail.bond-stress".
  static Random stream(std::uint64_t seed, const std::string& id) {
    constexpr std::uint64_t first = 2000;  // far from those of packings
    const auto number = parse_number(id.substr(id.rfind('.') + 1));
    return Random(seed, first + (number ? static_cast<std::uint64_t>(*number) : 0));
  }

 private:
  Param<Real> strength_;
  Param<Real> modulus_;
  Keeps<Real> factor_;
};

}  // namespace beadwork
