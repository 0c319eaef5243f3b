#include <Eigen/Eigenvalues>

#include "core/mechanics/virial.hpp"
#include "plugins/fail/scattered_strength.hpp"

namespace beadwork {

/// Removed discrete elements (RDEF): an element whose stress reaches the strength loses its bonds.   Eq (7)
/// docs/theory/bond-failure.md
class VirialStress final : public Failure {
 public:
  static constexpr const char* about =
      "An element loses all its bonds when the stress that they give it reaches the strength (RDEF)";
  ScatteredStrength strength{this, "Stress sigma_hyd at which an element fails", On::elements};
  Param<std::string> measure{this,
                             {.name = "measure",
                              .doc = "hydrostatic: the mean normal stress; principal: the largest of the three",
                              .fallback = "hydrostatic",
                              .choices = {"hydrostatic", "principal"}}};
  Reads<Real> hydrostatic{this, {"hydrostatic-stress", On::elements, "Pa", "Mean normal stress of the element"}};
  Reads<Sym3> virial{this, {"virial", On::elements, "Pa", "Stress of the element from its bonds"}};

  VirialStress() : Failure(On::elements) {}

  void choose() override {
    strength.choose();
    hydrostatic.want(*measure == "hydrostatic");
    virial.want(*measure == "principal");
  }

  void begin(const Domain& domain, std::uint64_t seed) override {
    strength.draw(domain.elements().column("id").view<Index>(), domain.size(), seed, *this, "");
  }

  void judge(const Domain& domain) override {
    judge_elements(domain, [&](Index i) { return (virial ? principal(virial[i]) : hydrostatic[i]) / strength(i); });
  }

  std::string mode() const override { return "virial-" + *measure; }

 private:
  static Real principal(const Sym3& stress) {
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    return solver.computeDirect(matrix(stress), Eigen::EigenvaluesOnly).eigenvalues()[2];
  }
};

}  // namespace beadwork
