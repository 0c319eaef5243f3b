// Curves are members of their watchers: what is known of them before a run, and that a watcher only fills rows.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/failure.hpp"
#include "tests/support/parts.hpp"

namespace beadwork {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::message_of;
using ::testing::Pair;
using testing::Parts;

/// Has two files, and a column more where the deck asks for it.
class TwoFiles final : public Watcher {
 public:
  static constexpr const char* about = "Writes two curves";
  Param<std::string> left{this, {.name = "left", .doc = "Name of the one", .fallback = "left"}};
  Param<std::string> right{this, {.name = "right", .doc = "Name of the other", .fallback = "right"}};
  Param<bool> squared{this, {.name = "squared", .doc = "Squares too", .fallback = "no"}};
  Curve one{this, left, {.columns = {{"steps", "1"}}}};
  Curve other{this, right, {.columns = {{"half", "1"}}, .y = {"half"}}};

  void choose() override {
    if (*squared) one.plan.columns.push_back({"squares", "1"});
  }
  void look(Sight& sight) override {
    const auto steps = static_cast<Real>(sight.moment().step);
    if (*squared)
      one.row({steps, steps * steps});
    else
      one.row({steps});
    other.row({steps / 2});
  }
};

std::string deck(const std::string& watch) {
  return R"(<scene><fill><lattice set="row" count="2 1 1" radius="1 mm" density="2000 kg/m^3"/></fill>
    <bond><spring name="s" between="row row" young="1 MPa"/></bond>
    <move><verlet time-step="1 us" until="100"/></move><watch>)" +
         watch + "</watch></scene>";
}

/// Remembers the rows by the name of the curve.
class Remembered final : public CurveSink {
 public:
  void row(const std::string& curve, const CurvePlan& plan, std::span<const Real> values) override {
    rows[curve] = {values.begin(), values.end()};
    columns[curve] = plan.columns.size();
  }
  std::map<std::string, std::vector<Real>> rows;
  std::map<std::string, std::size_t> columns;
};

Watcher& watcher_of(const Parts& parts) { return *parts.scene->stages.front().watchers.front(); }

TEST(Curves, of_a_scene_are_known_before_it_runs_with_the_columns_that_its_deck_asks_for) {
  const Parts parts(deck(R"(<two-files right="r" squared="yes"/>)"), {entry<TwoFiles>("two-files")});
  const auto& curves = watcher_of(parts).curves();
  ASSERT_EQ(curves.size(), 2u);
  EXPECT_EQ(*curves[0]->name(), "left");
  EXPECT_THAT(curves[0]->plan.columns, ElementsAre(Pair("steps", "1"), Pair("squares", "1")));
  EXPECT_EQ(*curves[1]->name(), "r");
}

TEST(Curves, that_would_be_one_file_are_told_whatever_their_parameters_are_called) {
  const auto said = [](const std::string& watch) {
    return message_of<DeckFailure>([&] { Parts(deck(watch), {entry<TwoFiles>("two-files")}); });
  };
  EXPECT_THAT(said(R"(<two-files/><force-curve name="right" of="row" axis="x"/>)"),
              HasSubstr("a curve 'right' exists already, made at"));
  EXPECT_THAT(said(R"(<energy-ledger name="left"/><two-files/>)"), HasSubstr("give this one another 'left'"));
  EXPECT_THAT(said(R"(<two-files left="x" right="x"/>)"), HasSubstr("give this one another 'right'"));
  EXPECT_THAT(said(R"(<two-files left="../x"/>)"), HasSubstr("'left' wants a name without"));
}

TEST(Curves, take_rows_while_somebody_records_and_not_else) {
  Parts parts(deck(R"(<two-files/>)"), {entry<TwoFiles>("two-files")});
  const auto& curves = watcher_of(parts).curves();
  EXPECT_THROW(curves[0]->row({1}), std::logic_error);
  Remembered sink;
  for (Curve* curve : curves) curve->write_to(&sink);
  curves[1]->row({0.5});
  EXPECT_THAT(sink.rows, ElementsAre(Pair("right", ElementsAre(0.5))));
  EXPECT_EQ(sink.columns.at("right"), 1u);
}

}  // namespace
}  // namespace beadwork
