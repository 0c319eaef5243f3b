#include "core/base/parallel.hpp"
#include "plugins/derive/over_bonds.hpp"

namespace beadwork {

/// Stress of an element: (1/2 Omega) sum of sym(r x f) over its bonds.   Eq (6); docs/theory/stress.md
class Virial final : public OverBonds {
 public:
  static constexpr const char* about = "Stress of the elements from the forces of their bonds, tension positive";
  Reads<Sym3> sum{this, field::virial_sum};
  Writes<Sym3> virial{this,
                      {"virial", On::elements, "Pa", "Stress of the element from its bonds: xx, xy, xz, yy, yz, zz"}};

  void derive(const Domain& domain) override {
    each_shared(
        domain.size(), [&](Index row) { virial.set(row, virial_stress(sum[row], volume(row))); }, 1024);
  }
};

}  // namespace beadwork
