// The stress of elements from the forces of their bonds, Eqs (6) and (7), as the loop sums it up.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <numbers>

#include "core/base/parallel.hpp"
#include "core/mechanics/rotation.hpp"
#include "core/mechanics/virial.hpp"
#include "tests/support/deck_run.hpp"
#include "tests/support/mechanics.hpp"
#include "tests/support/parts.hpp"

namespace beadwork {
namespace {

using testing::Parts;

/// A scene whose snapshot reads the stress of the elements, put into any state.
class Stressed {
 public:
  explicit Stressed(const std::string& fill, const std::string& bond, const std::string& derive = "")
      : parts_("<scene seed=\"3\"><fill>" + fill + "</fill><bond>" + bond + "</bond>" + derive +
               R"(<move><verlet time-step="1 ns" until="1"/></move>
               <watch><snapshot fields="virial hydrostatic-stress" every="1"/></watch></scene>)") {
    parts_.begin();
  }
  Domain& domain() { return parts_.state.domain(); }
  Index size() { return domain().size(); }
  View<Vec3> places() { return domain().elements().column("position").view<Vec3>(); }
  void turn_all(const Quat& by) {
    const auto q = domain().elements().column("orientation").view<Quat>();
    for (Index i = 0; i < size(); ++i) {
      places().set(i, rotate(by, places()[i]));
      q.set(i, by * Quat(q[i]));
    }
  }
  void evaluate(bool telling = true) {
    parts_.forces.evaluate(false, telling);
    if (telling) parts_.fresh.derive_all();
  }
  Mat3 stress(Index i) { return matrix(domain().elements().column("virial").view<Sym3>()[i]); }
  Real hydrostatic(Index i) { return domain().elements().column("hydrostatic-stress").view<Real>()[i]; }
  Real volume(Index i) {
    const Real r = domain().elements().column("radius").view<Real>()[i];
    return 4 * std::numbers::pi / 3 * r * r * r;
  }
  Vec3 force(Index i) { return domain().elements().column("force").view<Vec3>()[i]; }

 private:
  Parts parts_;
};

constexpr const char* chain = R"(<lattice set="row" count="5 1 1" radius="1 mm" density="2000 kg/m^3"/>)";
constexpr const char* springs = R"(<spring name="s" between="row row" young="1 GPa"/>)";
constexpr const char* packing =
    R"(<free-filling set="all" box="6 6 6 mm" count="200" density="1200 kg/m^3"/><forced-filling set="all" coordination="6"/>
       <relaxation set="all" overlap="1e-6"/>)";
constexpr const char* beams = R"(<cohesive-beam name="resin" between="all all" young="10 GPa" radius-ratio="0.6"/>)";

// N = E pi r^2 e in each bond: F s over the volume for an element between two, half of it at an end; tension is positive.
TEST(Stress, of_a_stretched_chain_is_force_times_spacing_over_the_volume) {
  for (const Real strain : {1e-3, -1e-3}) {
    Stressed row(chain, springs);
    for (Index i = 0; i < row.size(); ++i) row.places().set(i, Vec3(row.places()[i] * (1 + strain)));
    row.evaluate();
    const Real force = 1e9 * std::numbers::pi * 1e-6 * strain, spacing = 2e-3 * (1 + strain);
    for (Index i = 0; i < row.size(); ++i) {
      const Real expected = force * spacing / row.volume(i) * (i == 0 || i == row.size() - 1 ? 0.5 : 1);
      EXPECT_NEAR(row.stress(i)(0, 0), expected, 1e-9 * std::abs(expected)) << i;
      EXPECT_LT((row.stress(i) - row.stress(i)(0, 0) * Mat3(Vec3::UnitX() * Vec3::UnitX().transpose())).norm(),
                1e-12 * std::abs(expected));
      EXPECT_NEAR(row.hydrostatic(i), expected / 3, 1e-9 * std::abs(expected));
    }
  }
}

// The sum of Omega sigma is that of x f over the forces that hold every element where it is, found another way.
TEST(Stress, of_all_elements_adds_up_to_what_is_done_from_outside) {
  Stressed pack(packing, beams);
  Mat3 strain;
  strain << 2e-3, 1e-3, -5e-4, 3e-4, -1e-3, 7e-4, 2e-4, -4e-4, 1.5e-3;
  for (Index i = 0; i < pack.size(); ++i)
    pack.places().set(i, Vec3(pack.places()[i] + strain * Vec3(pack.places()[i])));
  pack.evaluate();
  Mat3 inside = Mat3::Zero(), outside = Mat3::Zero();
  Real trace = 0;
  for (Index i = 0; i < pack.size(); ++i) {
    inside += pack.volume(i) * pack.stress(i);
    trace += 3 * pack.volume(i) * pack.hydrostatic(i);
    outside -= Vec3(pack.places()[i]) * pack.force(i).transpose();
  }
  const Mat3 symmetric = 0.5 * (outside + outside.transpose());
  EXPECT_GT(symmetric.norm(), 1e-6);
  EXPECT_LT((inside - symmetric).norm(), 1e-10 * symmetric.norm());
  EXPECT_NEAR(trace, symmetric.trace(), 1e-10 * symmetric.norm());
}

TEST(Stress, turns_with_the_whole) {
  Stressed still(packing, beams), turned(packing, beams);
  Random random(4);
  const Quat by = test::random_rotation(random);
  for (Index i = 0; i < still.size(); ++i) {
    const Vec3 x = still.places()[i];
    const Vec3 moved = x + Vec3(1e-3 * x[1], -2e-3 * x[0], 1.5e-3 * x[2]);
    still.places().set(i, moved), turned.places().set(i, moved);
  }
  turned.turn_all(by);
  still.evaluate(), turned.evaluate();
  const Mat3 rotation = rotation_matrix(by);
  Real largest = 0;
  for (Index i = 0; i < still.size(); ++i) largest = std::max(largest, still.stress(i).norm());
  for (Index i = 0; i < still.size(); ++i) {
    EXPECT_LT((turned.stress(i) - rotation * still.stress(i) * rotation.transpose()).norm(), 1e-9 * largest);
    EXPECT_NEAR(turned.hydrostatic(i), still.hydrostatic(i), 1e-9 * largest);
  }
}

TEST(Stress, has_the_same_bits_on_one_and_two_threads) {
  Stressed pack(packing, beams);
  for (Index i = 0; i < pack.size(); ++i) pack.places().set(i, Vec3(pack.places()[i] * 1.001));
  std::vector<Mat3> stress;
  use_threads(1);
  pack.evaluate();
  for (Index i = 0; i < pack.size(); ++i) stress.push_back(pack.stress(i));
  use_threads(2);
  pack.evaluate();
  for (Index i = 0; i < pack.size(); ++i) EXPECT_EQ(pack.stress(i), stress[static_cast<std::size_t>(i)]);
  use_threads(1);
}

TEST(Stress, costs_nothing_in_an_evaluation_that_nobody_reads_it_of) {
  Stressed row(chain, springs);
  const auto sum = row.domain().elements().column("virial-trace-sum").view<Real>();
  const auto mark = [&] {
    for (Index i = 0; i < row.size(); ++i) sum[i] = 7;
  };
  mark();
  row.evaluate(false);
  for (Index i = 0; i < row.size(); ++i) EXPECT_EQ(sum[i], 7) << "nobody has added to it, nobody has cleared it";
  row.evaluate(true);
  for (Index i = 0; i < row.size(); ++i) EXPECT_LT(std::abs(sum[i]), 1e-12);
  Parts without(std::string("<scene><fill>") + chain + "</fill><bond>" + springs +
                R"(</bond><move><verlet until="1"/></move></scene>)");
  EXPECT_FALSE(without.state.domain().elements().find("virial-trace-sum"));
}

TEST(Stress, counts_the_families_that_the_deck_says) {
  const std::string fill = R"(<element set="a" at="0 0 0 mm" radius="1 mm" density="2000 kg/m^3"/>
    <element set="b" at="2 0 0 mm" radius="1 mm" density="2000 kg/m^3"/><element set="c" at="4 0 0 mm" radius="1 mm" density="2000 kg/m^3"/>)";
  const std::string bond = R"(<spring name="ab" between="a b" young="1 GPa"/>
    <cohesive-contact name="bc" between="b c" strength="100 MPa" energy="100 kJ/m^2" stiffness="1e12 Pa/m"/>)";
  const auto middle = [&](const std::string& derive) {
    Stressed three(fill, bond, derive);
    for (Index i = 0; i < 3; ++i) three.places().set(i, Vec3(three.places()[i] * 1.001));
    three.evaluate();
    return three.stress(1)(0, 0) * 2 * three.volume(1) / 2.002e-3;  // sum of the forces
  };
  const Real ab = 1e9 * std::numbers::pi * 1e-6 * 1e-3, bc = 1e12 * std::numbers::pi * 1e-6 * 2e-6;
  EXPECT_NEAR(middle(""), ab, 1e-6 * ab) << "contacts do not count of themselves";
  EXPECT_NEAR(middle(R"(<derive><virial of="bc"/><hydrostatic-stress of="bc"/></derive>)"), bc, 1e-6 * bc);
  EXPECT_NEAR(middle(R"(<derive><virial of="ab bc"/><hydrostatic-stress of="ab bc"/></derive>)"), ab + bc, 1e-6 * bc);
}

// ---- elements that fail

// The middle one of a cross of five is pulled at by four; each outer one by its own bond alone.
const std::string cross = R"(<scene seed="1"><fill>
    <element set="m" at="0 0 0 mm" radius="1 mm" density="2000 kg/m^3"/>
    <element set="e" at="2 0 0 mm" radius="1 mm" density="2000 kg/m^3"/><element set="w" at="-2 0 0 mm" radius="1 mm" density="2000 kg/m^3"/>
    <element set="n" at="0 2 0 mm" radius="1 mm" density="2000 kg/m^3"/><element set="s" at="0 -2 0 mm" radius="1 mm" density="2000 kg/m^3"/>
    <element set="far" at="4 0 0 mm" radius="1 mm" density="2000 kg/m^3"/></fill>
  <bond><spring name="a" between="m e" young="1 GPa"/><spring name="b" between="m w" young="1 GPa"/><spring name="c" between="m n" young="1 GPa"/>
    <spring name="d" between="m s" young="1 GPa"/><spring name="tail" between="e far" young="1 GPa"/></bond>
  <fail><virial-stress of="{0}" strength="{1} MPa" measure="{2}"/></fail>
  <load><pull set="e" axis="x" velocity="1 m/s"/><pull set="w" axis="x" velocity="-1 m/s"/><pull set="n" axis="y" velocity="1 m/s"/>
    <pull set="s" axis="y" velocity="-1 m/s"/><pull set="far" axis="x" velocity="1 m/s"/><hold set="m"/></load>
  <move><verlet time-step="0.1 us" until="{3}"/></move><watch><energy-ledger every="1"/></watch></scene>)";

// h = 4 l N/(6 Omega), N = E pi r^2 e, at the step k in which the strain is v k dt/L: both are known.
TEST(ElementsThatFail, lose_all_their_bonds_at_the_strength_and_no_others) {
  const auto done = testing::run_deck(fmt::format(fmt::runtime(cross), "a b c d tail", 2, "hydrostatic", 300));
  EXPECT_EQ(done.summary.at("breaks").at("virial-hydrostatic"), 4);
  const auto& use = done.summary.at("utilisation").at("fail.virial-stress");
  EXPECT_EQ(use.at("element"), 0);
  const Real r = 1e-3, omega = 4 * std::numbers::pi / 3 * r * r * r;
  int step = 0;
  for (Real h = 0; h < 2e6;) {
    ++step;
    const Real stretch = step * 1e-7, force = 1e9 * std::numbers::pi * r * r * stretch / (2 * r);
    h = 4 * (2 * r + stretch) * force / (6 * omega);
  }
  EXPECT_EQ(use.at("step"), step);
  const Real force = 1e9 * std::numbers::pi * r * r * step * 1e-7 / (2 * r);
  const Real energy = 4 * 0.5 * force * step * 1e-7;
  Real booked = 0;
  for (const char* name : {"a", "b", "c", "d"}) booked += done.energy(std::string("dissipated: ") + name);
  EXPECT_NEAR(booked, energy, 1e-9 * energy);
  EXPECT_EQ(done.energy("dissipated: tail"), 0);
}

TEST(ElementsThatFail, keep_bonds_of_families_that_the_criterion_does_not_name) {
  const auto done = testing::run_deck(fmt::format(fmt::runtime(cross), "a c", 2, "hydrostatic", 300));
  EXPECT_EQ(done.summary.at("breaks").at("virial-hydrostatic"), 2)
      << "all that hold it count in its stress, two may break";
}

// 's' and 'w' are pulled at too, but none of the bonds that may break holds them.
TEST(ElementsThatFail, are_those_that_a_bond_of_the_families_holds) {
  const auto done = testing::run_deck(fmt::format(fmt::runtime(cross), "tail", 0.001, "hydrostatic", 300));
  EXPECT_EQ(done.summary.at("breaks").at("virial-hydrostatic"), 1);
  const Real element = done.summary.at("utilisation").at("fail.virial-stress").at("element");
  EXPECT_TRUE(element == 1 || element == 5) << element;
}

// In a plane state s_xx = s_yy = 1.5 times the mean of three.
TEST(ElementsThatFail, by_their_largest_principal_stress_do_so_earlier) {
  const auto by = [](const std::string& measure) {
    const auto done = testing::run_deck(fmt::format(fmt::runtime(cross), "a b c d tail", 2, measure, 300));
    return done.summary.at("utilisation").at("fail.virial-stress").at("time").get<Real>();
  };
  EXPECT_NEAR(by("hydrostatic") / by("principal"), 1.5, 0.02);
}

// ---- strength with scatter

TEST(ScatteredStrength, is_drawn_when_its_bonds_are_made_in_whatever_stage) {
  const auto done =
      testing::run_deck(R"(<scene><fill><lattice set="all" count="4 4 4" radius="1 mm" density="2000 kg/m^3"/></fill>
    <fail><bond-stress of="s" strength="1 GPa" weibull="5" measure="axial"/></fail>
    <move><verlet time-step="1 us"/></move><watch><sensor field="fail.bond-stress.strength-factor" bonds="s" reduce="mean" every="1"/></watch>
    <stage until="2"><load><push set="all" force="1 0 0 N"/></load></stage>
    <stage until="2"><bond><spring name="s" between="all all" young="1 GPa"/></bond></stage></scene>)");
  EXPECT_EQ(done.failure, "");
  EXPECT_NEAR(done.curves.at("sensor").back().at("mean"), 1, 0.1);
  EXPECT_TRUE(done.summary.at("breaks").empty());
}

TEST(ScatteredStrength, is_drawn_from_the_law_of_weibull_with_its_mean) {
  const auto factors = [](int seed, const char* modulus) {
    Parts parts(fmt::format(
        R"(<scene seed="{}"><fill><lattice set="all" count="16 16 16" radius="1 mm" density="2000 kg/m^3"/></fill>
      <bond><spring name="s" between="all all" young="1 GPa"/></bond><fail><bond-stress of="s" strength="1 MPa" weibull="{}" measure="axial"/></fail>
      <move><verlet until="1"/></move></scene>)",
        seed, modulus));
    parts.begin();
    const BondTable& table = *parts.state.domain().find_family("s");
    const auto factor = std::as_const(table).rows().column("fail.bond-stress.strength-factor").view<Real>();
    std::vector<Real> all;
    for (Index row = 0; row < table.size(); ++row) all.push_back(factor[row]);
    return all;
  };
  const Real m = 8;
  std::vector<Real> f = factors(1, "8");
  ASSERT_GT(f.size(), 10000u);
  Real mean = 0;
  for (const Real x : f) mean += x / static_cast<Real>(f.size());
  const Real gamma = std::tgamma(1 + 1 / m), deviation = std::sqrt(std::tgamma(1 + 2 / m) / (gamma * gamma) - 1);
  EXPECT_NEAR(mean, 1, 4 * deviation / std::sqrt(static_cast<Real>(f.size())));
  std::sort(f.begin(), f.end());
  Real apart = 0;  // Kolmogorov and Smirnov: 1.63/sqrt(n) is passed by 99 of 100
  for (std::size_t k = 0; k < f.size(); ++k)
    apart = std::max(apart, std::abs(1 - std::exp(-std::pow(f[k] * gamma, m)) -
                                     (static_cast<Real>(k) + 0.5) / static_cast<Real>(f.size())));
  EXPECT_LT(apart, 1.63 / std::sqrt(static_cast<Real>(f.size())));
  EXPECT_EQ(factors(1, "8"), factors(1, "8"));
  EXPECT_NE(factors(1, "8"), factors(2, "8"));
}

}  // namespace
}  // namespace beadwork
