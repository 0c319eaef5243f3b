// What plugins hand over is checked where it comes in, and blamed on them.

#include "core/loop/handed_over.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "core/base/failure.hpp"
#include "core/base/memory.hpp"
#include "core/domain/vocabulary.hpp"

namespace beadwork {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr Real nan = std::numeric_limits<Real>::quiet_NaN();

/// Fills as it is told, and stands in the deck at line 7.
class Careless final : public Filler {
 public:
  static constexpr const char* about = "Hands over whatever it is told";
  explicit Careless(std::function<void(Domain&)> hand_over) : hand_over_(std::move(hand_over)) {
    const auto source = std::make_shared<const Source>(Source{"deck.xml", ""});
    Scope scope;
    Complaints complaints;
    Node node;
    node.at = {source, 7, 6, 0};
    configure(node, "fill.careless", scope, complaints);
  }
  void fill(Domain& domain, const FillJob&) override { hand_over_(domain); }

 private:
  std::function<void(Domain&)> hand_over_;
};

Real& number(Domain& domain, const char* column, Index row) {
  return domain.elements().column(column).view<Real>()[row];
}

/// What is said of three elements of which one thing has been changed.
std::string blame_for(const std::function<void(Domain&)>& change) {
  Domain domain;
  domain.elements().add(field::mass);
  Careless filler([&](Domain& d) {
    d.add_elements(3);
    for (Index row = 0; row < 3; ++row) {
      number(d, "radius", row) = 1e-3;
      number(d, "mass", row) = 1e-6;
      d.elements().column("position").view<Vec3>().set(row, Vec3(2e-3 * row, 0, 0));
    }
    d.sets()["all"] = {0, 1, 2};
    change(d);
  });
  const Log nobody;
  filler.fill(domain, {.seed = 0, .log = nobody, .report = [](const std::string&) {}});
  try {
    check_elements(filler, domain);
  } catch (const PhysicsFailure& failure) {
    return failure.what();
  }
  return "it was taken";
}

TEST(HandedOver, elements_that_are_sound_are_taken) {
  EXPECT_EQ(blame_for([](Domain&) {}), "it was taken");
}

TEST(HandedOver, numbers_that_are_none_are_blamed_on_the_filler_at_its_place) {
  EXPECT_THAT(
      blame_for([](Domain& d) { number(d, "mass", 1) = nan; }),
      AllOf(StartsWith("deck.xml:7:6: error: plugin fill.careless"), HasSubstr("element 1 with mass = nan kg")));
  EXPECT_THAT(blame_for([](Domain& d) { number(d, "mass", 2) = 0; }),
              HasSubstr("element 2 with mass = 0 kg: it must be finite and > 0"));
  EXPECT_THAT(blame_for([](Domain& d) { number(d, "radius", 0) = -1; }), HasSubstr("radius = -1 m"));
  EXPECT_THAT(blame_for([](Domain& d) { d.elements().column("position").view<Vec3>().set(1, Vec3(0, nan, 0)); }),
              HasSubstr("element 1 at 0 nan 0 m"));
  EXPECT_THAT(blame_for([](Domain& d) { d.elements().column("position").view<Vec3>().set(1, Vec3(1e200, 0, 0)); }),
              HasSubstr("too far away"));
}

TEST(HandedOver, sets_hold_rows_that_are_there_each_once_and_in_order) {
  EXPECT_THAT(blame_for([](Domain& d) { d.sets()["all"].push_back(3); }),
              HasSubstr("put row 3 into set 'all', but there are 3 elements"));
  EXPECT_THAT(blame_for([](Domain& d) { d.sets()["odd"] = {-1}; }), HasSubstr("put row -1 into set 'odd'"));
  EXPECT_THAT(blame_for([](Domain& d) { d.sets()["odd"] = {1, 1}; }), HasSubstr("out of order"));
}

TEST(HandedOver, rows_of_bonds_are_those_of_the_table) {
  Careless plugin([](Domain&) {});
  const Moment moment{.step = 12};
  const Index sound[] = {0, 4}, wild[] = {0, 5};
  EXPECT_NO_THROW(check_rows(sound, 5, "bonds that break", plugin, moment));
  try {
    check_rows(wild, 5, "bonds that break", plugin, moment);
    FAIL() << "row 5 of 5 was taken";
  } catch (const PhysicsFailure& failure) {
    EXPECT_THAT(failure.what(), AllOf(HasSubstr("plugin fill.careless failed at step 12"), HasSubstr("row 5")));
  }
}

TEST(HandedOver, constraints_have_a_set_an_axis_and_a_motion) {
  Careless plugin([](Domain&) {});
  Domain domain;
  domain.sets()["left"] = {};
  const auto motion = [](Real) { return PrescribedMotion{}; };
  EXPECT_NO_THROW(check_constraint({.by = "", .set = "left", .axis = 5, .motion = motion}, domain, plugin));
  EXPECT_THROW(check_constraint({.by = "", .set = "right", .axis = 0, .motion = motion}, domain, plugin),
               PhysicsFailure);
  EXPECT_THROW(check_constraint({.by = "", .set = "left", .axis = 6, .motion = motion}, domain, plugin),
               PhysicsFailure);
  EXPECT_THROW(check_constraint({.by = "", .set = "left", .axis = 0, .motion = {}}, domain, plugin), PhysicsFailure);
}

TEST(Memory, says_what_does_not_fit) {
  EXPECT_EQ(why_no_memory(1e6, "elements", 200, 1e9), "");
  EXPECT_EQ(why_no_memory(1e7, "elements", 200, 1e9),
            "1e+07 elements need at least 2 GB of memory, of which there are 1 GB: 5e+06 are possible");
  EXPECT_GT(memory_at_most(), 1e6);
}

}  // namespace
}  // namespace beadwork
