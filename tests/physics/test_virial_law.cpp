#include "core/mechanics/virial.hpp"

#include <gtest/gtest.h>

#include "core/mechanics/spring.hpp"
#include "tests/support/mechanics.hpp"

namespace beadwork {
namespace {

using namespace test;

TEST(virial, tension_is_positive) {
  const SpringRest<Real> rest{1, 10};
  const Vec3 d(1.1, 0, 0);
  const Vec3 f = spring_force(rest, d);
  EXPECT_LT(f[0], 0);                                           // end 2 is pulled back
  EXPECT_NEAR(bond_virial_trace(d, f), 1.1 * 10 * 0.1, 1e-14);  // l N
  EXPECT_NEAR(bond_virial(d, f).xx, 1.1 * 10 * 0.1, 1e-14);
  EXPECT_LT(bond_virial_trace(Vec3(0.9, 0, 0), spring_force(rest, Vec3(0.9, 0, 0))), 0);
}

TEST(virial, both_ends_get_the_same) {
  Random random(1);
  const Vec3 d = random_vector(random, 1), f = random_vector(random, 1);
  const Mat3 one = matrix(virial_stress(bond_virial(d, f), 1)),
             other = matrix(virial_stress(bond_virial<Real>(-d, -f), 1));
  EXPECT_EQ(one, other);
}

TEST(virial, is_the_symmetric_product_of_equation_six) {
  Random random(2);
  const Vec3 r = random_vector(random, 1), on_i = random_vector(random, 1);  // r_ij and f_ij of end 1: force is -f_ij
  const Mat3 expected = 1 / (2 * 0.7) * 0.5 * (r * on_i.transpose() + on_i * r.transpose());
  const auto found = bond_virial<Real>(r, -on_i);
  EXPECT_LT((matrix(virial_stress(found, 0.7)) - expected).norm(), 1e-15);
  EXPECT_NEAR(hydrostatic_stress<Real>(bond_virial_trace<Real>(r, -on_i), 0.7), expected.trace() / 3, 1e-15);
}

TEST(virial, the_elements_of_a_stretched_chain_add_up_to_force_times_length) {
  // sum Omega_i sigma_i = V Sigma = F l for a chain of bonds that all carry F, when every bond is counted at
  // both ends
  const int bonds = 7;
  const Real F = 3, s = 0.4, omega = 0.05;
  Real sum = 0;
  for (int i = 0; i <= bonds; ++i) {
    Sym3 total{};
    const int mine = i == 0 || i == bonds ? 1 : 2;
    for (int b = 0; b < mine; ++b) total.xx += bond_virial(Vec3(s, 0, 0), Vec3(-F, 0, 0)).xx;
    sum += omega * virial_stress(total, omega).xx;
  }
  EXPECT_NEAR(sum, F * s * bonds, 1e-13);
}

}  // namespace
}  // namespace beadwork
