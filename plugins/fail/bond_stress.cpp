#include "core/domain/vocabulary.hpp"
#include "core/mechanics/beam.hpp"
#include "core/plugin/failure.hpp"
#include "plugins/fail/scattered_strength.hpp"

namespace beadwork {

/// Breakable bonds (BBF): a bond breaks when the largest stress in its section reaches the strength.
/// docs/theory/bond-failure.md
class BondStress final : public Failure {
 public:
  static constexpr const char* about =
      "A bond breaks when the largest stress in its section reaches the strength (BBF)";
  ScatteredStrength strength{this, "Stress sigma_fail at which a bond breaks", On::bonds};
  Param<std::string> measure{this,
                             {.name = "measure",
                              .doc = "axial: N/A, which is all that springs have; axial-bending: largest normal stress "
                                     "of the section; principal: with the shear of twisting",
                              .fallback = "axial-bending",
                              .choices = {"axial", "axial-bending", "principal"}}};
  Reads<Real> axial_force{this, field::axial_force};
  Reads<Real> bending_moment{this, field::bending_moment};
  Reads<Real> twisting_moment{this, field::twisting_moment};
  Reads<Real> section_radius{this, field::section_radius};

  void choose() override {
    strength.choose();
    bending_moment.want(*measure != "axial");
    twisting_moment.want(*measure == "principal");
    chosen_ = *measure == "axial" ? 0 : *measure == "axial-bending" ? 1 : 2;
  }

  void begin(const Domain& domain, std::uint64_t seed) override {
    each_family(domain,
                [&](const BondTable& table) { strength.draw(table.id(), table.size(), seed, *this, table.name()); });
  }

  void judge(const Domain& domain) override {
    judge_bonds(domain, [&](Index b) { return stress(b) / strength(b); });
  }

  std::string mode() const override { return *measure; }

 private:
  int chosen_ = 0;
  Real stress(Index b) const {
    const Real moment = bending_moment ? bending_moment[b] : 0;
    const Real twist = twisting_moment ? twisting_moment[b] : 0;
    const BeamStress<Real> all =
        beam_stress<Real>(BeamSection<Real>{axial_force[b], moment, moment, twist}, section_radius[b]);
    return chosen_ == 0 ? all.axial : chosen_ == 1 ? all.axial_bending : all.principal;
  }
};

}  // namespace beadwork
