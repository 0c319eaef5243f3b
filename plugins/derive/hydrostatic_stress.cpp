#include "core/base/parallel.hpp"
#include "plugins/derive/over_bonds.hpp"

namespace beadwork {

/// A third of the trace of the virial, for which one number a bond is enough.   Eqs (6), (7); docs/theory/stress.md
class HydrostaticStress final : public OverBonds {
 public:
  static constexpr const char* about =
      "Mean normal stress of the elements from the forces of their bonds, tension positive";
  Reads<Real> sum{this, field::virial_trace_sum};
  Writes<Real> stress{this, {"hydrostatic-stress", On::elements, "Pa", "Mean normal stress of the element"}};

  void derive(const Domain& domain) override {
    each_shared(
        domain.size(), [&](Index row) { stress[row] = hydrostatic_stress<Real>(sum[row], volume(row)); }, 1024);
  }
};

}  // namespace beadwork
