#include "core/domain/vocabulary.hpp"
#include "core/plugin/kinds.hpp"

namespace beadwork {

/// Place of an element less its place when the run began.
class Displacement final : public Derived {
 public:
  static constexpr const char* about = "Displacement of the elements since the beginning";
  Reads<Vec3> position{this, field::position};
  Keeps<Vec3> origin{this, {"origin", On::elements, "m", "Place when the run began"}};
  Keeps<Real> noted{this, {"noted", On::scene, "1", "1 once the places of the beginning are known"}};
  Writes<Vec3> displacement{this, {"displacement", On::elements, "m", "Place less the place when the run began"}};

  void derive(const Domain& domain) override {
    if (noted[0] == 0)
      for (Index row = 0; row < domain.size(); ++row) origin.set(row, position[row]);
    noted[0] = 1;
    for (Index row = 0; row < domain.size(); ++row) displacement.set(row, position[row] - origin[row]);
  }
};

}  // namespace beadwork
