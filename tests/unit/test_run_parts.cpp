// The parts of a run, each alone.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/domain/vocabulary.hpp"
#include "core/io/checkpoint.hpp"
#include "core/loop/looks.hpp"
#include "tests/support/parts.hpp"

namespace beadwork {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::Parts;
using testing::Scratch;

constexpr const char* two_stages = R"(<scene>
  <fill>
    <element set="left" at="0 0 0 mm" radius="1 mm" density="2000 kg/m^3"/>
    <element set="right" at="2 0 0 mm" radius="1 mm" density="2000 kg/m^3"/>
  </fill>
  <load><hold set="left"/></load>
  <move><verlet time-step="1 us"/></move>
  <stage name="one" until="10"><bond><spring name="soft" between="left right" young="1 MPa"/></bond><load><pull set="right" axis="x" velocity="1 m/s"/></load></stage>
  <stage name="two" until="10"><bond><spring name="hard" between="left right" young="10 MPa" gap="0.1"/></bond><load><pull set="right" axis="x" velocity="2 m/s"/></load></stage>
</scene>)";

TEST(RunState, has_a_row_for_each_constraint_of_each_stage_that_a_checkpoint_brings_back) {
  const Scratch scratch;
  Parts parts(two_stages), later(two_stages);
  ASSERT_EQ(parts.state.constraints.size(), 2u);
  parts.state.constraints[0].back().work = 1.5;
  parts.state.constraints[1].back().work = 2.5;
  parts.state.peaks[1][0].force = 7;
  parts.state.released[1] = 0.25;
  parts.state.looks_owed = 3;
  save_checkpoint(scratch / "c.h5", parts.state.domain(), {});
  load_checkpoint(scratch / "c.h5", later.state.domain());
  EXPECT_EQ(later.state.constraints[0].back().work, 1.5);
  EXPECT_EQ(later.state.constraints[1].back().work, 2.5);
  EXPECT_EQ(later.state.constraints[1].front().work, 0);
  EXPECT_EQ(later.state.peaks[1][0].force, 7);
  EXPECT_EQ(later.state.peaks[0][0].force, 0);
  EXPECT_EQ(later.state.released[1], 0.25);
  EXPECT_EQ(later.state.looks_owed, 3);
}

TEST(Balance, books_what_bonds_hold_that_act_no_longer) {
  Parts parts(two_stages);
  parts.begin();
  for (int k = 0; k < 5; ++k) parts.step();
  parts.fresh.complete();
  EnergySums before, after;
  parts.balance.energies(before);
  parts.balance.release(parts.scene->stages[1]);
  parts.balance.energies(after);
  EXPECT_GT(before.in_bonds, 0);
  EXPECT_EQ(after.in_bonds, 0);
  EXPECT_DOUBLE_EQ(parts.state.released[0], before.in_bonds);
  EXPECT_DOUBLE_EQ(after.beyond_work(), before.beyond_work());
  EXPECT_THAT(parts.said.back(), HasSubstr("'soft' acts no longer"));
}

// ---- what breaks

constexpr const char* chain = R"(<scene>
  <fill>
    <lattice set="row" count="4 1 1" radius="1 mm" density="2000 kg/m^3"/>
    <region set="left" where="x &lt; 1.5 mm"/><region set="right" where="x > 5.5 mm"/>
  </fill>
  <bond><spring name="s" between="row row" young="1 MPa"/></bond>
  <load><hold set="left"/><pull set="right" axis="x" velocity="1 m/s"/></load>
  <move><verlet time-step="1 us" until="100"/></move>
  <fail><picky of="s" name="one"/><picky of="s" name="two"/></fail>
  <watch><counting name="a" every="2"/><counting name="b" every="1" at="3, 5"/></watch>
</scene>)";

/// Finds what it is told, by row, and remembers what it saw.
class Picky final : public Failure {
 public:
  static constexpr const char* about = "Breaks what it is told to";
  Param<std::string> name{this, {.name = "name", .doc = "Name"}};
  void judge(const Domain& domain) override {
    seen.push_back(domain.find_family(of->front())->live());
    const auto& found = *name == "one" ? one : two;
    judge_bonds(domain, [&](Index row) { return row < Index(found.size()) ? found[std::size_t(row)] : 0; });
  }
  std::string mode() const override { return *name; }
  static inline std::vector<Real> one, two;
  static inline std::vector<Index> seen;
};

class Counting final : public Watcher {
 public:
  static constexpr const char* about = "Counts its looks";
  Param<std::string> name{this, {.name = "name", .doc = "Name"}};
  Reads<Vec3> displacement{this, {"displacement", On::elements, Type::vec3, "m", "Displacement", ""}};
  void look(Sight& sight) override {
    if (*name == fails) throw std::runtime_error("no more");
    looks.emplace_back(*name, sight.moment().step);
  }
  static inline std::vector<std::pair<std::string, std::int64_t>> looks;
  static inline std::string fails;
};

/// Moves nothing, and has what is most overloaded break alone.
class OneByOne final : public Mover {
 public:
  static constexpr const char* about = "Lets one thing break at a time";
  void choose_rotations(bool) override {}
  void prepare(Workings& w, bool) override { w.evaluate(true); }
  void step(Workings& w) override { w.evaluate(true), ++w.moment().step; }
  Breaks breaks() const override { return {1, 0}; }
};

/// Judges elements, as it is told by row.
class PickyOfElements final : public Failure {
 public:
  static constexpr const char* about = "Lets those elements fail that it is told to";
  PickyOfElements() : Failure(On::elements) {}
  void judge(const Domain& domain) override {
    judge_elements(domain, [&](Index row) { return row < Index(found.size()) ? found[std::size_t(row)] : 0; });
  }
  std::string mode() const override { return "element"; }
  static inline std::vector<Real> found;
};

std::vector<PluginEntry> own() {
  return {entry<Picky>("picky"), entry<Counting>("counting"), entry<OneByOne>("one-by-one"),
          entry<PickyOfElements>("picky-of-elements")};
}

TEST(Breaking, fells_once_what_several_criteria_name_and_lets_all_see_one_configuration) {
  Parts parts(chain, own());
  parts.begin();
  for (int k = 0; k < 5; ++k) parts.step();
  EXPECT_EQ(parts.breaking.live(), 3);
  Picky::seen.clear();
  Picky::one = {1.1, 0, 1.5}, Picky::two = {0, 1.2, 1.1};
  EnergySums before;
  parts.fresh.complete();
  parts.balance.energies(before);
  parts.breaking.judge();
  EXPECT_THAT(Picky::seen, ElementsAre(3, 3));
  EXPECT_EQ(parts.breaking.live(), 0);
  const BreakLog& log = parts.state.domain().breaks();
  ASSERT_EQ(log.breaks.size(), 3u);
  EXPECT_EQ(log.modes[static_cast<std::size_t>(log.breaks[1].mode)], "one");
  EXPECT_EQ(log.modes[static_cast<std::size_t>(log.breaks[2].mode)], "two");
  EXPECT_EQ(log.breaks[2].step, 5);
  EXPECT_DOUBLE_EQ(parts.state.released[0], before.in_bonds);
  EXPECT_EQ(parts.state.uses[0].second.value, 1.5);
  EXPECT_EQ(parts.state.uses[1].second.value, 1.2);
  const auto force = parts.state.domain().elements().column("force").view<Vec3>();
  for (Index row = 1; row < 3; ++row) EXPECT_LT(Vec3(force[row]).norm(), 1e-15) << "what is broken pulls no longer";
}

/// The chain above with other sections, between the same elements.
std::string chain_with(const std::string& bond, const std::string& fail, const std::string& move) {
  return R"(<scene><fill><lattice set="row" count="4 1 1" radius="1 mm" density="2000 kg/m^3"/></fill><bond>)" + bond +
         "</bond><fail>" + fail + "</fail><move>" + move +
         R"(</move><watch><snapshot fields="utilisation" every="1"/></watch></scene>)";
}
constexpr const char* spring = R"(<spring name="s" between="row row" young="1 MPa"/>)";
constexpr const char* verlet = R"(<verlet time-step="1 us" until="100"/>)";

TEST(Breaking, fells_the_highest_alone_where_the_mover_asks_for_it) {
  Parts parts(
      chain_with(spring, R"(<picky of="s" name="one"/><picky of="s" name="two"/>)", R"(<one-by-one until="9"/>)"),
      own());
  parts.begin();
  Picky::one = {1.1, 1.3, 0}, Picky::two = {1.2, 0, 1.5};
  parts.breaking.judge();
  ASSERT_EQ(parts.state.domain().breaks().breaks.size(), 1u);
  EXPECT_EQ(parts.state.domain().breaks().breaks[0].bond, 2);
  EXPECT_EQ(parts.state.domain().breaks().modes[0], "two");
  Picky::one = {1.1, 1.3}, Picky::two = {1.2, 0};
  parts.breaking.judge();
  ASSERT_EQ(parts.state.domain().breaks().breaks.size(), 2u);
  EXPECT_EQ(parts.state.domain().breaks().breaks[1].bond, 1);
}

TEST(Breaking, fells_all_bonds_of_an_element_in_the_families_that_are_named_each_once) {
  const std::string two =
      R"(<spring name="s" between="row row" young="1 MPa"/><spring name="t" between="row row" young="2 MPa"/>
    <spring name="u" between="row row" young="3 MPa"/>)";
  Parts parts(chain_with(two, R"(<picky-of-elements of="s t"/>)", verlet), own());
  parts.begin();
  PickyOfElements::found = {0, 1, 1.5, 0};
  parts.breaking.judge();
  const BreakLog& log = parts.state.domain().breaks();
  ASSERT_EQ(log.breaks.size(), 6u) << "three bonds of each of two families";
  std::vector<Index> whose;
  for (const Break& b : log.breaks) whose.push_back(b.element);
  EXPECT_THAT(whose, ElementsAre(1, 1, 1, 1, 2, 2)) << "the bond between two that fail goes with the first";
  EXPECT_EQ(parts.state.domain().find_family("u")->live(), 3);
  EXPECT_EQ(parts.state.domain().find_family("s")->live(), 0);
  EXPECT_EQ(parts.state.uses[0].second.element, 2);
}

TEST(Breaking, shows_to_readers_the_largest_of_what_several_criteria_find) {
  Parts parts(chain_with(spring, R"(<picky of="s" name="one"/><picky of="s" name="two"/>)", verlet), own());
  parts.begin();
  Picky::one = {0.1, 0.5, 0.2}, Picky::two = {0.4, 0.3, 0.6};
  parts.breaking.judge();
  const auto use = parts.state.domain().find_family("s")->rows().column("utilisation").view<Real>();
  EXPECT_EQ(use[0], 0.4);
  EXPECT_EQ(use[1], 0.5);
  EXPECT_EQ(use[2], 0.6);
}

// The fourth flies by itself.
TEST(Breaking, finds_no_utilisation_of_an_element_that_has_nothing_to_lose) {
  Parts parts(R"(<scene><fill><lattice set="row" count="3 1 1" radius="1 mm" density="2000 kg/m^3"/>
      <element set="alone" at="20 0 0 mm" radius="1 mm" density="2000 kg/m^3"/></fill>
    <bond><spring name="s" between="row row" young="1 MPa"/></bond>
    <fail><picky-of-elements of="s"/></fail><move>)" +
                  std::string(verlet) + "</move></scene>",
              own());
  parts.begin();
  PickyOfElements::found = {0.2, 0.9, 0.4, 7};
  parts.breaking.judge();
  EXPECT_TRUE(parts.state.domain().breaks().breaks.empty());
  EXPECT_EQ(parts.state.uses[0].second.element, 1);
  const auto use = parts.state.domain().elements().column(field::element_utilisation.name).view<Real>();
  EXPECT_EQ(use[1], 0.9);
  EXPECT_EQ(use[3], 0);
}

TEST(Breaking, blames_a_criterion_that_finds_no_number) {
  Parts parts(chain_with(spring, R"(<picky of="s" name="one"/>)", verlet), own());
  parts.begin();
  Picky::one = {0.1, std::nan(""), 0.2};
  EXPECT_THAT(testing::message_of<PhysicsFailure>([&] { parts.breaking.judge(); }),
              AllOf(HasSubstr("fail.picky"), HasSubstr("bond 1 of 's', between elements 1 and 2, is no number")));
}

TEST(Links, lead_from_an_element_to_its_live_bonds) {
  Parts parts(chain_with(spring, R"(<picky of="s" name="one"/>)", verlet), own());
  parts.begin();
  BondTable& table = *parts.state.domain().find_family("s");
  const Links all(table, 4);
  EXPECT_THAT(all.of(0), ElementsAre(0));
  EXPECT_THAT(all.of(1), ElementsAre(0, 1));
  table.state()[0] = State::broken;
  table.sweep();
  const Links left(table, 4);
  EXPECT_THAT(left.of(0), ElementsAre());
  ASSERT_EQ(left.of(1).size(), 1u);
  EXPECT_EQ(table.id()[left.of(1)[0]], 1);
}

// ---- who may change what

template <class D>
concept LendsPlaces = requires(D& domain) {
  domain.elements().column("position").template view<Vec3>().at(0, 0) = 1;
};
template <class D>
concept LetsBreak = requires(D& domain) {
  domain.find_family("s")->state()[0] = State::broken;
};
static_assert(LendsPlaces<Domain> && LetsBreak<Domain>);
static_assert(!LendsPlaces<const Domain>, "a watcher that moves an element does not compile");
static_assert(!LetsBreak<const Domain>, "nor does one that breaks a bond");

TEST(Forces, of_an_offer_leave_forces_and_energies_as_they_are) {
  Parts parts(chain, own());
  parts.begin();
  for (int k = 0; k < 5; ++k) parts.step();
  const auto force = parts.state.domain().elements().column("force").view<Vec3>();
  const Vec3 before = force[2];
  EXPECT_GT(before.norm(), 0);
  parts.forces.offer();
  EXPECT_EQ(Vec3(force[2]), before);
  EXPECT_TRUE(parts.offered.is_told());
  parts.fresh.begin_step();
  EXPECT_FALSE(parts.offered.is_told());
}

// ---- who looks when

class NowhereToWrite final : public Sight {
 public:
  explicit NowhereToWrite(const Parts& parts) : parts_(parts) {}
  const Domain& domain() const override { return parts_.state.domain(); }
  const Moment& moment() const override { return parts_.state.moment; }
  std::span<const Constraint> constraints() const override { return parts_.state.held(); }
  void energies(EnergySink&) const override {}
  Real initial_energy() const override { return 0; }
  void frame(const FramePlan&) override {}

 private:
  const Parts& parts_;
};

TEST(Looks, come_by_cadence_and_at_moments_once_and_at_the_end_for_all_that_have_not_just_looked) {
  Parts parts(chain, own());
  NowhereToWrite sight(parts);
  Looks looks(parts.state, parts.fresh, parts.offered, sight, parts.options.log);
  Picky::one = Picky::two = {};
  Counting::looks.clear();
  parts.begin();
  for (int k = 0; k < 3; ++k) parts.step(), looks.look();
  using Look = std::pair<std::string, std::int64_t>;
  EXPECT_THAT(Counting::looks, ElementsAre(Look("b", 1), Look("a", 2), Look("b", 2), Look("b", 3)));
  looks.look_at_end();
  EXPECT_EQ(Counting::looks.back(), Look("a", 3)) << "b has just looked";
  EXPECT_EQ(Counting::looks.size(), 5u);
  looks.tell_of_missed_moments("it was enough");
  ASSERT_EQ(parts.warned.size(), 1u) << "the third step had its look, the fifth never came";
  EXPECT_THAT(parts.warned[0], HasSubstr("did not come to 5 steps: it was enough first"));
}

TEST(Looks, that_are_owed_when_one_fails_are_taken_after_a_restart) {
  Parts parts(chain, own());
  NowhereToWrite sight(parts);
  Looks looks(parts.state, parts.fresh, parts.offered, sight, parts.options.log);
  Picky::one = Picky::two = {};
  parts.begin();
  parts.step(), parts.step();
  Counting::looks.clear();
  Counting::fails = "b";
  EXPECT_THROW(looks.look(), PhysicsFailure);
  Counting::fails.clear();
  EXPECT_EQ(parts.state.looks_owed, 1);
  looks.look_owed();
  using Look = std::pair<std::string, std::int64_t>;
  EXPECT_THAT(Counting::looks, ElementsAre(Look("a", 2), Look("b", 2)));
  EXPECT_EQ(parts.state.looks_owed, 0);
}

// ---- what is brought up to date

TEST(Fresh, derives_a_field_once_for_all_who_read_it_until_the_state_is_another) {
  Parts parts(chain, own());
  parts.begin();
  Derived& displacement = *parts.scene->derived.front();
  const auto field = parts.state.domain().elements().column("displacement").view<Vec3>();
  const Watcher& watcher = *parts.state.stage().watchers[0];
  parts.fresh.outdate();
  displacement.derive(parts.state.domain());
  field.set(1, Vec3(9, 9, 9));
  parts.fresh.for_watcher(watcher);
  EXPECT_NE(Vec3(field[1]), Vec3(9, 9, 9));
  field.set(1, Vec3(9, 9, 9));
  parts.fresh.for_watcher(*parts.state.stage().watchers[1]);
  EXPECT_EQ(Vec3(field[1]), Vec3(9, 9, 9)) << "it stood already";
  parts.fresh.outdate();
  parts.fresh.for_watcher(watcher);
  EXPECT_NE(Vec3(field[1]), Vec3(9, 9, 9));
}

}  // namespace
}  // namespace beadwork
