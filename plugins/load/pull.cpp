#include <fmt/format.h>

#include "core/base/text.hpp"
#include "core/base/units.hpp"
#include "core/plugin/kinds.hpp"

namespace beadwork {

/// Moves a set along one axis with a prescribed velocity; the other axes stay free.
class Pull final : public Load {
 public:
  static constexpr const char* about = "Moves a set along one axis with a prescribed velocity: each element, or their mean only";
  Param<std::string> set{this, {.name = "set", .doc = "Set that is moved", .role = Role::set}};
  Param<std::string> axis{this, {.name = "axis", .doc = "Axis along which it is moved; an axis that is not named is free", .choices = {"x", "y", "z"}}};
  Param<std::string> grip{this, {.name = "grip", .doc = "each element alike, or the mean over the set", .fallback = "each", .choices = {"each", "mean"}}};
  Param<Real> velocity{this, {.name = "velocity", .unit = "m/s", .doc = "Velocity that is reached", .one_of = "motion"}};
  Param<Real> rise{this, {.name = "rise", .unit = "s", .range = not_negative, .doc = "Time over which the velocity sets in, smoothly (no jump of acceleration)", .fallback = "0 s", .instead = "table"}};
  Param<std::string> table{this, {.name = "table", .doc = "Instead of 'velocity': times and velocities with units, joined by commas: \"0 s 0 m/s, 1 ms 2 m/s\"; straight lines between them", .one_of = "motion"}};

  void check(Complaints& complaints) const override {
    if (table.in_deck()) read_table(&complaints);
    if (table.in_deck() && rise.in_deck()) complaints.error(rise.at(), "'rise' belongs to 'velocity', a table has its own course");
  }

  std::vector<Constraint> constraints() const override {
    Constraint c;
    c.by = id();
    c.set = *set;
    c.axis = (*axis)[0] - 'x';
    c.grip = *grip == "each" ? Grip::each : Grip::mean;
    c.driven = true;
    if (table.in_deck())
      c.motion = [course = VelocityTable(read_table(nullptr))](Real t) { return course.at(t); };
    else
      c.motion = [ramp = SmoothRamp{*velocity, *rise}](Real t) { return ramp.at(t); };
    return {c};
  }

 private:
  // "0 s 0 m/s, 1 ms 2 m/s"; a row that cannot be read is complained of, and left out.
  std::vector<VelocityTable::Row> read_table(Complaints* complaints) const {
    std::vector<VelocityTable::Row> rows;
    for (const std::string& row : split(*table, ',')) {
      const auto words = split_words(row);
      const auto time = words.size() == 4 ? value(words[0], words[1], "s") : std::nullopt;
      const auto speed = words.size() == 4 ? value(words[2], words[3], "m/s") : std::nullopt;
      if (time && speed && (rows.empty() || *time > rows.back().time)) {
        rows.push_back({*time, *speed});
      } else if (complaints) {
        complaints->error(table.at(), fmt::format("'table' wants rows such as \"1 ms 2 m/s\" in increasing time, got \"{}\"", trim(row)));
      }
    }
    if (complaints && !rows.empty() && rows.front().time != 0)
      complaints->error(table.at(), "the first row of 'table' is that of the start of the stage, 0 s");
    if (rows.empty()) rows.push_back({0, 0});
    return rows;
  }

  static std::optional<Real> value(const std::string& number, const std::string& unit, const char* wanted) {
    const auto plain = parse_number(number);
    const auto found = find_unit(unit);
    if (!plain || !found || !(found->dimension == find_unit(wanted)->dimension)) return std::nullopt;
    return found->to_si(*plain);
  }
};

}  // namespace beadwork
