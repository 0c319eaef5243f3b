#include "plugins/contact/colliding.hpp"

namespace beadwork {

/// f = k delta, with k of the deck or of the modulus.   docs/theory/contact.md
class Penalty final : public Colliding<LinearContact> {
 public:
  static constexpr const char* about =
      "Contacts with a normal force in proportion to the overlap, friction and restitution";
  Param<Real> normal_stiffness{this,
                               {.name = "stiffness",
                                .unit = "N/m",
                                .range = positive,
                                .doc = "Normal stiffness k of every contact",
                                .knob = Knob::smaller_is_faster,
                                .one_of = "hardness"}};
  Param<Real> young{this,
                    {.name = "young",
                     .unit = "Pa",
                     .range = positive,
                     .doc = "Modulus E of the elements: k = E pi R/2 with the harmonic mean R of their radii, as a rod "
                            "between the centres has; twice that at a wall, to which the rod is half as long",
                     .one_of = "hardness"}};
  Param<Real> tangential_ratio_{this,
                                {.name = "tangential-ratio",
                                 .range = positive,
                                 .doc = "Tangential over normal stiffness",
                                 .fallback = "0.2857142857142857"}};

 protected:
  Real stiffness_between(Real r1, Real r2) const override {
    return normal_stiffness.given() ? *normal_stiffness : *young * std::numbers::pi * r1 * r2 / (r1 + r2);
  }
  Real stiffness_at_plane(Real r) const override {
    return normal_stiffness.given() ? *normal_stiffness : *young * std::numbers::pi * r;
  }
  Real tangential_ratio() const override { return *tangential_ratio_; }
};

}  // namespace beadwork
