#include "plugins/contact/colliding.hpp"

namespace beadwork {

/// Hertz and Mindlin: elastic spheres of one material.   docs/theory/contact.md
class Hertz final : public Colliding<HertzContact> {
 public:
  static constexpr const char* about = "Contacts of elastic spheres (Hertz, Mindlin), with friction and restitution";
  Param<Real> young{this, {.name = "young", .unit = "Pa", .range = positive, .doc = "Young's modulus of the elements"}};
  Param<Real> poisson{this,
                      {.name = "poisson",
                       .range = {-1, 0.5, true, false},
                       .doc = "Poisson's ratio of the elements",
                       .fallback = "0.3"}};
  Param<Real> overlap_{this,
                       {.name = "overlap",
                        .range = {0, 1, true, true},
                        .doc = "Largest overlap over the distance of the centres that the time step is made for: the "
                               "harder the collisions, the larger",
                        .fallback = "0.005"}};

 protected:
  // 4/3 E* sqrt(R*), E* = E/2(1 - nu^2), R* = R1 R2/(R1 + R2)
  Real stiffness_between(Real r1, Real r2) const override {
    return 2 * *young / (3 * (1 - *poisson * *poisson)) * std::sqrt(r1 * r2 / (r1 + r2));
  }
  // The partner is rigid and flat: E* = E/(1 - nu^2), R* = R.
  Real stiffness_at_plane(Real r) const override { return 4 * *young / (3 * (1 - *poisson * *poisson)) * std::sqrt(r); }
  // 8 G* sqrt(R* delta) over 2 E* sqrt(R* delta), G* = G/2(2 - nu); the same at a wall, where both are doubled
  Real tangential_ratio() const override { return 2 * (1 - *poisson) / (2 - *poisson); }
  Real expected_overlap() const override { return *overlap_; }
};

}  // namespace beadwork
