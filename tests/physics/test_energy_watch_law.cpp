// Energy from nothing ends a run or is warned of, whatever the estimate of the time step says; sound runs are left
// alone.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/deck_run.hpp"

namespace beadwork {
namespace {

using std::numbers::pi;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string chain(const std::string& bond, const std::string& load, const std::string& mover, const std::string& until,
                  int count = 6) {
  return fmt::format(R"(<scene>
    <fill><lattice set="bar" count="{} 1 1" radius="1 mm" density="2000 kg/m^3"/>
      <region set="left" where="x &lt; 2 mm"/><region set="right" where="x > {} mm"/></fill>
    <bond>{}</bond>
    <load>{}</load>
    <move><verlet {} until="{}"/></move>
    <watch><energy-ledger every="10"/></watch>
  </scene>)",
                     count, 2 * count - 3, bond, load, mover, until);
}

constexpr const char* pulled =
    R"(<hold set="left" axes="x" grip="mean"/><pull set="right" axis="x" velocity="0.05 m/s" rise="0.1 ms" grip="mean"/><hold set="bar" axes="y z"/>)";

testing::DeckRun rope(const std::string& stated, const std::string& until) {
  return testing::run_deck(
      chain(fmt::format(R"(<understated-rope name="s" between="bar bar" stiffness="1e6 N/m" stated="{}"/>)", stated),
            pulled, "", until));
}

TEST(EnergyWatch, stops_a_law_whose_tangent_is_too_small_below_the_step_that_it_promises) {
  const auto run = rope("0.7", "20000");
  EXPECT_THAT(run.failure, HasSubstr("tangent")) << run.summary.at("quality").dump(1);
  EXPECT_THAT(run.failure, HasSubstr("that no work accounts for"));
  EXPECT_EQ(run.summary.at("status"), "failed");
}

TEST(EnergyWatch, lets_the_same_law_be_where_it_states_all) {
  const auto run = rope("1", "20000");
  EXPECT_EQ(run.failure, "");
  EXPECT_THAT(run.warned, IsEmpty());
}

// What velocity Verlet keeps, energy less dt^2/8 sum |F|^2/m, it keeps beyond the critical step too, while the energy
// itself grows without end. The fastest mode of a fixed and a pulled chain of 8: omega^2 = 4 k/m sin^2(6 pi/14), k of
// springs of 10 GPa between spheres of 1 mm.
constexpr Real chain_mass = 2000 * 4 / 3.0 * pi * 1e-9, chain_stiffness = 10e9 * pi * 1e-6 / 2e-3;
testing::DeckRun chain_at(const std::string& bond, const std::string& mover, int steps) {
  const char* ends =
      R"(<hold set="left" axes="x"/><hold set="bar" axes="y z"/><pull set="right" axis="x" velocity="0.05 m/s" rise="0.1 ms"/>)";
  return testing::run_deck(chain(bond, ends, mover, fmt::format("{}", steps), 8));
}
const Real critical_step = 2 / std::sqrt(4 * chain_stiffness / chain_mass) / std::sin(6 * pi / 14);

TEST(EnergyWatch, a_chain_beyond_its_step_is_noticed_although_its_shadow_energy_stays) {
  const auto beyond = chain_at(R"(<spring name="s" between="bar bar" young="10 GPa"/>)",
                               fmt::format(R"(time-step="{} s")", 1.00005 * critical_step), 1300);
  EXPECT_THAT(beyond.failure, HasSubstr("that no work accounts for"));
  EXPECT_EQ(beyond.summary.at("quality").at("verdict"), "poor");
  const auto apart = chain_at(R"(<spring name="s" between="bar bar" young="10 GPa"/>)",
                              fmt::format(R"(time-step="{} s")", 1.00005 * critical_step), 2000);
  EXPECT_THAT(apart.failure, HasSubstr("in one step")) << "it flies apart before the balance is looked at again";
  EXPECT_EQ(apart.summary.at("quality").at("verdict"), "not judged");
  const auto within = chain_at(R"(<spring name="s" between="bar bar" young="10 GPa"/>)",
                               fmt::format(R"(time-step="{} s")", 0.9 * critical_step), 2000);
  EXPECT_EQ(within.failure, "");
  EXPECT_THAT(within.warned, IsEmpty());
}

TEST(EnergyWatch, a_tangent_just_too_small_is_noticed_before_the_excess_is_as_large_as_the_work) {
  // 'safety' 0.9 of the stated limit is 1.00005 of the true one
  const auto stated = [](Real share) {
    return fmt::format(R"(<understated-rope name="s" between="bar bar" stiffness="{} N/m" stated="{}"/>)",
                       chain_stiffness, share);
  };
  const Real honest = chain_at(stated(1), "", 10).summary.at("time_step").get<Real>();
  const Real share = std::pow(honest / (1.00005 * critical_step), 2);
  const auto run = chain_at(stated(share), "", 1200);
  EXPECT_FALSE(run.failure.empty() && run.warned.empty()) << run.summary.at("quality").dump(1);
}

// Both ends prescribed, nothing free: closed again, there is no work left with which what rounding leaves could be
// compared.
TEST(EnergyWatch, lets_ten_thousand_cycles_of_a_sound_contact_be) {
  std::string table = "0 s 0 m/s";
  for (int cycle = 0; cycle < 10000; ++cycle)
    for (int quarter = 1; quarter <= 4; ++quarter)
      table += fmt::format(", {:.9g} us {} m/s", 0.5 * (4 * cycle + quarter),
                           quarter == 1   ? "0.2"
                           : quarter == 3 ? "-0.2"
                                          : "0");
  const auto run = testing::run_deck(fmt::format(R"(<scene>
    <fill><element set="one" at="0 0 0 mm" radius="1 mm" density="2000 kg/m^3"/><element set="two" at="2 0 0 mm" radius="1 mm" density="2000 kg/m^3"/></fill>
    <bond><cohesive-contact name="c" between="one two" strength="10 MPa" energy="100 J/m2" onset-ratio="0.1"/></bond>
    <load><hold set="one"/><hold set="two" axes="y z"/><pull set="two" axis="x" table="{}"/></load>
    <move><verlet time-step="0.1 us" until="200000"/></move>
    <watch><energy-ledger every="1000"/></watch>
  </scene>)",
                                                 table));
  EXPECT_EQ(run.failure, "");
  EXPECT_THAT(run.warned, IsEmpty());
}

struct Sound {
  const char* name;
  std::string deck;
};
void PrintTo(const Sound& sound, std::ostream* out) { *out << sound.name; }

class SoundRun : public ::testing::TestWithParam<Sound> {};

TEST_P(SoundRun, is_not_warned_of) {
  const auto run = testing::run_deck(GetParam().deck);
  EXPECT_EQ(run.failure, "");
  EXPECT_THAT(run.warned, IsEmpty());
}

const std::string beam = R"(<cohesive-beam name="s" between="bar bar" young="10 GPa" radius-ratio="0.5"/>)";
const std::string damped_spring =
    R"(<damped-spring name="s" between="bar bar" stiffness="1e6 N/m" viscosity="1 N.s/m"/>)";
const std::string hit =
    R"(<initial-velocity set="right" velocity="0 1 0 m/s"/><initial-velocity set="left" velocity="1 0 0 m/s"/>)";
const std::string shaken =
    R"(<hold set="left"/><pull set="right" axis="y" table="0 s 0 m/s, 13.3 us 1 m/s, 37.1 us -2 m/s, 51 us 1.5 m/s, 90 us 0 m/s"/>)";

INSTANTIATE_TEST_SUITE_P(
    EnergyWatch, SoundRun,
    ::testing::Values(
        Sound{"near the limit", chain(beam, hit, R"(safety="0.99")", "20000", 2)},
        Sound{"free pair of springs",
              chain(R"(<spring name="s" between="bar bar" young="10 GPa"/>)",
                    R"(<initial-velocity set="right" velocity="1 0 0 m/s"/>)", R"(safety="0.99")", "20000", 2)},
        Sound{"beta", chain(beam, hit, R"(beta="0.9")", "20000")},
        Sound{"small beta", chain(beam, pulled, R"(beta="0.5")", "20000")},
        Sound{"beta and local damping", chain(beam, shaken, R"(beta="0.95" local-damping="0.3")", "20000")},
        Sound{"local damping", chain(beam, hit, R"(local-damping="0.7")", "20000")},
        Sound{"bond damping", chain(beam, shaken, R"(bond-damping="0.3")", "20000")},
        Sound{"stiff dashpots", chain(beam, hit, R"(bond-damping="0.9")", "20000")},
        Sound{"law that damps",
              chain(damped_spring, R"(<initial-velocity set="right" velocity="1 0 0 m/s"/>)", "", "20000")},
        Sound{"mixed precision", chain(beam, shaken, R"(precision="mixed")", "50000")},
        Sound{"table", chain(beam, shaken, "", "20000")},
        Sound{"pushed", chain(beam, R"(<hold set="left"/><push set="right" force="10 3 0 N"/>)", "", "20000")},
        Sound{"pushed with beta",
              chain(beam, R"(<hold set="left"/><push set="right" force="10 3 0 N"/>)", R"(beta="0.9")", "20000")},
        Sound{"at rest", chain(beam, R"(<hold set="left"/>)", "", "20000")},
        Sound{"nothing held, nothing moved", chain(beam, "", "", "20000")}),
    [](const auto& of) {
      std::string name = of.param.name;
      std::erase_if(name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); });
      return name;
    });

}  // namespace
}  // namespace beadwork
