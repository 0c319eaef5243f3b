#include <Eigen/LU>

#include "core/base/failure.hpp"
#include "core/domain/vocabulary.hpp"
#include "core/mechanics/sphere.hpp"
#include "core/mechanics/virial.hpp"
#include "core/plugin/kinds.hpp"

namespace beadwork {

/// Mean stress and strain of a set, as a curve.   docs/theory/stress.md
class StressStrain final : public Watcher {
 public:
  static constexpr const char* about =
      "Mean stress and strain of a set as a curve: the stress of its bonds over a volume, the strain that fits its "
      "displacements best";
  Param<std::string> of{this, {.name = "of", .doc = "Set that is watched", .role = Role::set}};
  Param<Real> volume{this,
                     {.name = "volume",
                      .unit = "m^3",
                      .range = positive,
                      .doc = "Volume of the solid in which these elements lie: theirs and that of the pores between "
                             "them"}};
  Param<std::string> name{this,
                          {.name = "name", .doc = "Name of the curve and of its file", .fallback = "stress-strain"}};
  Curve curve{this,
              name,
              {.columns = {{"strain-xx", "1"},
                           {"strain-yy", "1"},
                           {"strain-zz", "1"},
                           {"strain-xy", "1"},
                           {"strain-xz", "1"},
                           {"strain-yz", "1"},
                           {"stress-xx", "Pa"},
                           {"stress-yy", "Pa"},
                           {"stress-zz", "Pa"},
                           {"stress-xy", "Pa"},
                           {"stress-xz", "Pa"},
                           {"stress-yz", "Pa"}},
               .y = {"stress-xx", "stress-yy", "stress-zz"}}};
  Reads<Vec3> position{this, field::position};
  Reads<Real> radius{this, field::radius};
  Reads<Vec3> displacement{this, {"displacement", On::elements, "m", "Place less the place when the run began"}};
  Reads<Sym3> virial{this, {"virial", On::elements, "Pa", "Stress of the element from its bonds"}};

  void choose() override { curve.plan.title = "Mean stress of " + *of; }

  void look(Sight& sight) override {
    const Set& members = sight.domain().set(*of);
    const Mat3 stretch = gradient(members);
    const Mat3 stress = mean_stress(members);
    const auto strain = [&](int i, int j) { return 0.5 * (stretch(i, j) + stretch(j, i)); };
    curve.row({strain(0, 0), strain(1, 1), strain(2, 2), strain(0, 1), strain(0, 2), strain(1, 2), stress(0, 0),
               stress(1, 1), stress(2, 2), stress(0, 1), stress(0, 2), stress(1, 2)});
  }

 private:
  // sum_i Omega_i sigma_i / V
  Mat3 mean_stress(const Set& members) const {
    Mat3 sum = zero<Mat3>();
    for (const Index row : members) sum += sphere_volume(radius[row]) * matrix(virial[row]);
    return sum / *volume;
  }

  // G of u = u0 + G X, by least squares over the places X at the beginning.
  Mat3 gradient(const Set& members) const {
    Vec3 place = zero<Vec3>(), shift = zero<Vec3>();
    for (const Index row : members) {
      place += position[row] - displacement[row];
      shift += displacement[row];
    }
    place /= static_cast<Real>(members.size());
    shift /= static_cast<Real>(members.size());
    Mat3 moved = zero<Mat3>(), spread = zero<Mat3>();
    for (const Index row : members) {
      const Vec3 x = position[row] - displacement[row] - place;
      moved += (displacement[row] - shift) * x.transpose();
      spread += x * x.transpose();
    }
    const Eigen::FullPivLU<Eigen::Matrix3d> solver(spread);
    if (!solver.isInvertible())
      refuse(of.at(), "set '" + *of + "' lies in a plane, on a line or in a point: it has no strain");
    return moved * solver.inverse();
  }
};

}  // namespace beadwork
