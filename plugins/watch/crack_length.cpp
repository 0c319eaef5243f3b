#include <fmt/format.h>

#include <algorithm>

#include "core/base/units.hpp"
#include "core/domain/vocabulary.hpp"
#include "plugins/watch/against.hpp"
#include "plugins/watch/broken.hpp"

namespace beadwork {

/// How far a crack has run along a plane of cohesive contacts, by two contours: where contacts are fully open, and
/// where damage begins. What lies between them is the process zone (Fig 15 of the paper). Both go by the largest
/// opening so far: a damaged contact that closes again still counts.
///
/// Each contour is the length of the pre-crack plus the damaged area (open area) over the width: for a straight front
/// that is its place, for a ragged one its mean place.
class CrackLength final : public Watcher {
 public:
  static constexpr const char* about =
      "Length of a crack along a plane of cohesive contacts, by open contacts and by damage, and the process zone";
  Param<std::string> of{this, {.name = "of", .doc = "Family of the contacts", .role = Role::family}};
  Param<std::string> axis{this, {.name = "axis", .doc = "Axis along which the crack runs", .choices = {"x", "y", "z"}}};
  Param<Real> from{
      this, {.name = "from", .unit = "m", .doc = "Place of the crack's mouth along the axis", .fallback = "0 m"}};
  Param<Real> start{this,
                    {.name = "start", .unit = "m", .doc = "Place of the first contact: the end of the pre-crack"}};
  Param<Real> end{this, {.name = "end", .unit = "m", .doc = "Place where the contacts end"}};
  Against against{this};
  Param<std::string> name{this, {.name = "name", .doc = "Name of the curve and of its file", .fallback = "crack"}};
  Param<Formula> reference{
      this,
      {.name = "reference",
       .unit = "1",
       .doc = "Crack length over the whole length that theory predicts, as a formula in 'displacement'",
       .optional = true,
       .variables = {{"displacement", find_unit("m")->dimension}}}};
  Curve curve{this,
              name,
              {.columns = {{"displacement", "m"},
                           {"crack length open", "1"},
                           {"crack length damaged", "1"},
                           {"process zone", "m"}},
               .title = "Crack length over the whole length",
               .y = {"crack length open", "crack length damaged", "process zone"}}};
  Reads<Real> damage{this, field::damage};
  Reads<Real> area{this, {"area", On::bonds, "m2", "Area that a contact stands for"}};

  std::vector<std::string> families() const override { return {*of}; }

  void choose() override {
    curve.plan.x = against.abscissa();
    if (reference.given()) curve.plan.columns.push_back({"reference", "1"});
  }

  void check(Complaints& complaints) const override {
    const char* course = "the crack runs from 'from' over 'start' to 'end'";
    if (*from > *start)
      complaints.error(from.at(), fmt::format("'from' = {} must not lie beyond 'start' = {}: {}", from.text(),
                                              start.text(), course));
    if (*end <= *start)
      complaints.error(end.at(),
                       fmt::format("'end' = {} must lie beyond 'start' = {}: {}", end.text(), start.text(), course));
  }

  void check_stages(std::span<const Constraint> constraints, Complaints& complaints) const override {
    against.check(constraints, complaints);
  }

  void look(Sight& sight) override {
    const BondTable& table = *sight.domain().find_family(*of);
    const LostArea lost(table, area.view(), damage.view());
    const Real length = *end - *from;
    const Real per_area = lost.all > 0 ? (*end - *start) / lost.all : 0;  // no contacts yet: they come in a later stage
    const Real by_open = *start - *from + per_area * lost.open;
    const Real by_damage = *start - *from + per_area * lost.damaged;
    std::vector<Real> row{against.displacement(sight), by_open / length, by_damage / length, by_damage - by_open};
    if (reference.given()) {
      const Real displacement = row[0];
      row.push_back(std::min<Real>(1, (*reference)({&displacement, 1})));
    }
    curve.row(row);
  }
};

}  // namespace beadwork
