// What every bond law owes to those who call it, for all that ship, that the template shows, and that tests have: forces
// that are a pure function of state and accepted history, and the derivative of these.
#include <gmock/gmock.h>

#include <Eigen/Eigenvalues>

#include "core/mechanics/rotation.hpp"
#include "tests/support/mechanics.hpp"
#include "tests/support/parts.hpp"

namespace beadwork {
namespace {

using test::random_vector;
using test::Vector12;
using testing::Parts;

/// One deck line for each law, and for each loop that it has.
const std::vector<std::string> laws = {
    R"(<cohesive-beam name="b" between="one two" young="1 GPa" radius-ratio="0.7"/>)",
    R"(<spring name="b" between="one two" young="1 GPa"/>)",
    R"(<rope name="b" between="one two" stiffness="1 MN/m"/>)",
    R"(<damped-spring name="b" between="one two" stiffness="1 MN/m" viscosity="30 N.s/m"/>)",
    R"(<understated-rope name="b" between="one two" stiffness="1 MN/m" stated="0.5"/>)",
    R"(<cohesive-contact name="b" between="one two" strength="20 MPa" energy="1 kJ/m^2" onset-ratio="0.2"/>)",
    R"(<cohesive-contact name="b" between="one two" strength="20 MPa" energy="1 kJ/m^2" onset-ratio="0.2" modes="shear"/>)",
    R"(<cohesive-contact name="b" between="one two" strength="20 MPa" energy="1 kJ/m^2" onset-ratio="0.2" modes="both"/>)",
    R"(<cohesive-contact name="b" between="one two" strength="20 MPa" energy="1 kJ/m^2" onset-ratio="0.2" modes="both" coupling="benzeggagh-kenane" exponent="1.7"/>)",
    R"(<cohesive-contact name="b" between="one two" strength="20 MPa" energy="1 kJ/m^2" onset-ratio="0.2" normal="plane" plane-normal="1 1 0"/>)",
    R"(<cohesive-contact name="b" between="one two" strength="20 MPa" energy="1 kJ/m^2" onset-ratio="0.2" normal="plane" plane-normal="1 1 0" modes="shear"/>)",
    R"(<cohesive-contact name="b" between="one two" strength="20 MPa" energy="1 kJ/m^2" onset-ratio="0.2" normal="plane" plane-normal="1 1 0" modes="both"/>)",
    R"(<cohesive-contact name="b" between="one two" strength="20 MPa" energy="1 kJ/m^2" onset-ratio="0.2" normal="plane" plane-normal="1 1 0" modes="both" coupling="linear"/>)",
};

/// Two elements and one bond of a law, put into any state.
class Bonded {
 public:
  explicit Bonded(const std::string& law)
      : parts_(R"(<scene><fill><element set="one" at="0 0 0 mm" radius="1 mm" density="2000 kg/m^3"/>
                  <element set="two" at="1.5 1.1 0.7 mm" radius="1 mm" density="2000 kg/m^3"/></fill><bond>)" +
                   law + R"(</bond><load><push set="one" force="0 0 0 N" torque="0 0 0 N.m"/></load>
                  <move><verlet time-step="1 ns" until="1"/></move></scene>)",
               {}, {BEADWORK_BINARY_DIR "/lib/test-laws", BEADWORK_BINARY_DIR "/lib/template"}) {
    parts_.begin();
    law_ = parts_.state.laws.front().first;
    table_ = parts_.state.laws.front().second;
  }

  Domain& domain() { return parts_.state.domain(); }
  PairLaw& law() { return *law_; }
  BondTable& table() { return *table_; }
  bool turns() { return domain().elements().find("orientation"); }

  void put(const test::Pair& p, const Vec3& v1, const Vec3& v2) {
    Table& e = domain().elements();
    e.column("position").view<Vec3>().set(0, p.x1);
    e.column("position").view<Vec3>().set(1, p.x2);
    if (turns()) {
      e.column("orientation").view<Quat>().set(0, p.q1);
      e.column("orientation").view<Quat>().set(1, p.q2);
    }
    e.column("velocity").view<Vec3>().set(0, v1);
    e.column("velocity").view<Vec3>().set(1, v2);
  }
  void act(bool settle) {
    domain().clear_loads();
    domain().clear_halo();
    law_->act(domain(), *table_, {.clear = true, .settle = settle});
    domain().gather();
  }
  /// Forces and torques at a state, in the order of the coordinates.
  Vector12 loads(const test::Pair& p, const Vec3& v1, const Vec3& v2) {
    put(p, v1, v2);
    act(false);
    Vector12 all = Vector12::Zero();
    for (Index i = 0; i < 2; ++i) {
      all.segment<3>(6 * i) = domain().elements().column("force").view<Vec3>()[i];
      if (const Column* torque = domain().elements().find("torque"))
        all.segment<3>(6 * i + 3) = std::as_const(*torque).view<Vec3>()[i];
    }
    return all;
  }
  /// What the bond keeps, number by number.
  std::vector<Real> kept() {
    std::vector<Real> all;
    for (Column* column : table_->rows().columns()) {
      if (!column->kept()) continue;
      if (column->field().type == Type::real) all.push_back(column->view<Real>()[0]);
      if (column->field().type == Type::vec3)
        for (int c = 0; c < 3; ++c) all.push_back(column->view<Vec3>().at(0, c));
      if (column->field().type == Type::state) all.push_back(static_cast<Real>(column->view<State>()[0]));
    }
    return all;
  }

 private:
  Parts parts_;
  PairLaw* law_;
  BondTable* table_;
};

const Vec3 rest(1.5e-3, 1.1e-3, 0.7e-3);

test::Pair random_state(Random& random, Real size) {
  return {Vec3(0, 0, 0), rest + random_vector(random, size * rest.norm()), exp_map(random_vector(random, size)),
          exp_map(random_vector(random, size))};
}

/// -d(loads)/d(coordinates) by differences of fourth order; places by a step, turns by that over the length of the bond.
Matrix12 by_differences(Bonded& bond, const test::Pair& p, const Vec3& v1, const Vec3& v2, Real step) {
  Matrix12 k;
  for (int j = 0; j < 12; ++j) {
    const Real h = j / 3 % 2 == 0 ? step : step / rest.norm();
    const auto at = [&](Real by) { return bond.loads(test::moved(p, Vector12::Unit(j) * (by * h)), v1, v2); };
    k.col(j) = -(8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * h);
  }
  return k;
}

/// Rows and columns of turns, scaled by the length of the bond, weigh as much as those of places.
Matrix12 even(Matrix12 k) {
  for (int j = 0; j < 12; ++j)
    if (j / 3 % 2 == 1) k.col(j) /= rest.norm(), k.row(j) /= rest.norm();
  return k;
}

TEST(BondLaws, each_that_there_is_stands_in_this_test) {
  const Catalogue catalogue =
      Catalogue::open({BEADWORK_BINARY_DIR "/lib/test-laws", BEADWORK_BINARY_DIR "/lib/template"});
  for (const std::string& tag : catalogue.tags(Kind::bond))
    EXPECT_THAT(laws, ::testing::Contains(::testing::HasSubstr("<" + tag + " ")));
}

TEST(BondLaws, state_the_derivative_of_their_forces_also_where_they_are_damaged) {
  Random random(31);
  for (const std::string& text : laws) {
    Bonded bond(text);
    for (int trial = 0; trial < 12; ++trial) {
      const Vec3 v1 = random_vector(random, 1), v2 = random_vector(random, 1);
      const test::Pair accepted = random_state(random, 0.01 * trial), p = random_state(random, 0.02);
      bond.put(accepted, v1, v2);
      bond.act(true);  // what is remembered from here on
      const Matrix12 expected = even(by_differences(bond, p, v1, v2, 1e-8));
      bond.put(p, v1, v2);
      const Matrix12 found = even(bond.law().tangent(bond.domain(), bond.table(), 0, Slope::consistent));
      const Real size =
          std::max(expected.norm(), even(bond.law().tangent(bond.domain(), bond.table(), 0, Slope::stiffest)).norm());
      EXPECT_LT((found - expected).norm(), 1e-6 * size) << text << " trial " << trial;
    }
  }
}

TEST(BondLaws, act_without_leaving_a_trace_until_a_state_is_accepted) {
  Random random(32);
  for (const std::string& text : laws) {
    Bonded bond(text);
    for (int trial = 0; trial < 5; ++trial) {
      const Vec3 v = random_vector(random, 1);
      bond.put(random_state(random, 0.02 * trial), v, -v);
      bond.act(true);
      const std::vector<Real> before = bond.kept();
      const Vector12 once = bond.loads(random_state(random, 0.05), v, -v);
      for (int k = 0; k < 9; ++k) bond.loads(random_state(random, 0.05), v, -v);
      EXPECT_EQ(bond.kept(), before) << text;
      ASSERT_TRUE(once.allFinite());
    }
  }
}

TEST(BondLaws, have_secants_that_are_never_negative_and_no_stiffer_than_the_stiffest) {
  Random random(33);
  for (const std::string& text : laws) {
    if (text.find("understated") != std::string::npos) continue;  // its mistake is the point of it
    Bonded bond(text);
    for (int trial = 0; trial < 8; ++trial) {
      bond.put(random_state(random, 0.02 * trial), zero<Vec3>(), zero<Vec3>());
      bond.act(true);
      bond.put(random_state(random, 0.02), zero<Vec3>(), zero<Vec3>());
      const auto modes = [&](Slope slope) {
        const Eigen::Matrix<double, 12, 12> k = even(bond.law().tangent(bond.domain(), bond.table(), 0, slope));
        EXPECT_LE((k - k.transpose()).norm(), 1e-12 * k.norm()) << text;
        return Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 12, 12>>(k).eigenvalues().eval();
      };
      const auto secant = modes(Slope::secant), stiffest = modes(Slope::stiffest);
      EXPECT_GT(secant.minCoeff(), -1e-9 * stiffest.maxCoeff()) << text;
      EXPECT_LT(secant.maxCoeff(), 1.05 * stiffest.maxCoeff()) << text;
    }
  }
}

}  // namespace
}  // namespace beadwork
