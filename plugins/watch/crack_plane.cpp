#include <algorithm>
#include <cmath>

#include "core/domain/bodies.hpp"
#include "core/domain/vocabulary.hpp"
#include "plugins/watch/against.hpp"
#include "plugins/watch/broken.hpp"

namespace beadwork {

/// Where bonds break along an axis, and whether the crack has run through: no bond joins the two faces any more.
/// Figs 21-25, 31 and 32 of the paper as numbers; docs/theory/bond-failure.md
class CrackPlane final : public Watcher {
 public:
  static constexpr const char* about =
      "Where bonds break along an axis, how many, and whether the crack has parted two faces, as a curve";
  Param<std::vector<std::string>> of{
      this, {.name = "of", .doc = "Families of the bonds that make up the solid", .role = Role::family}};
  Param<std::string> axis{
      this,
      {.name = "axis", .doc = "Axis along which places are told: normal to the crack", .choices = {"x", "y", "z"}}};
  Param<std::vector<std::string>> faces{this,
                                        {.name = "faces",
                                         .doc = "Two sets: the crack has run through when no chain of bonds of these "
                                                "families joins an element of the one to one of the other",
                                         .role = Role::set,
                                         .count = 2}};
  Param<Real> plane{this,
                    {.name = "plane",
                     .unit = "m",
                     .doc = "Place along the axis where the crack is expected, with 'within'",
                     .optional = true}};
  Param<Real> within{this,
                     {.name = "within",
                      .unit = "m",
                      .range = positive,
                      .doc = "Distance from 'plane' up to which a break counts as near it",
                      .optional = true}};
  Param<std::string> contacts{
      this,
      {.name = "interface",
       .doc = "Family of cohesive contacts of which the damaged and the open share of the area are told too",
       .optional = true,
       .role = Role::family}};
  Against against{this};
  Param<std::string> name{this,
                          {.name = "name", .doc = "Name of the curve and of its file", .fallback = "crack-plane"}};
  Curve curve{this,
              name,
              {.columns = {{"displacement", "m"},
                           {"broken", "1"},
                           {"broken share", "1"},
                           {"mean place", "m"},
                           {"spread of places", "m"},
                           {"parted", "1"}},
               .title = "Broken bonds",
               .y = {"broken share", "parted"}}};
  Reads<Real> damage{this, field::damage};
  Reads<Real> area{this, {"area", On::bonds, "m2", "Area that a contact stands for"}};

  std::vector<std::string> families() const override {
    return contacts.given() ? std::vector<std::string>{*contacts} : std::vector<std::string>{};
  }

  void choose() override {
    damage.want(contacts.given());
    area.want(contacts.given());
    curve.plan.x = against.abscissa();
    if (plane.given()) curve.plan.columns.push_back({"share near the plane", "1"});
    if (!contacts.given()) return;
    curve.plan.columns.push_back({"damaged share of the interface", "1"});
    curve.plan.columns.push_back({"open share of the interface", "1"});
    curve.plan.y.push_back("damaged share of the interface");
  }

  void check(Complaints& complaints) const override {
    if (faces.given() && (*faces)[0] == (*faces)[1])
      complaints.error(faces.at(), "'faces' are one and the same set: a crack parts two");
    if (plane.given() != within.given())
      complaints.error((plane.given() ? plane : within).at(), "'plane' and 'within' stand together, or neither does");
  }

  void check_stages(std::span<const Constraint> constraints, Complaints& complaints) const override {
    against.check(constraints, complaints);
  }

  void look(Sight& sight) override {
    const Broken broken(sight.domain(), *of, (*axis)[0] - 'x');
    const auto count = static_cast<Real>(broken.places.size());
    Real sum = 0, squares = 0, near = 0;
    for (const Real place : broken.places) {
      sum += place;
      if (plane.given()) near += std::abs(place - *plane) <= *within;
    }
    const Real mean = count > 0 ? sum / count : 0;
    for (const Real place : broken.places) squares += (place - mean) * (place - mean);
    std::vector<Real> row{against.displacement(sight),
                          count,
                          broken.breakable > 0 ? count / broken.breakable : 0,
                          mean,
                          count > 0 ? std::sqrt(squares / count) : 0,
                          have_parted(sight) ? 1.0 : 0.0};
    if (plane.given()) row.push_back(count > 0 ? near / count : 0);
    if (contacts.given()) add_interface(*sight.domain().find_family(*contacts), row);
    curve.row(row);
  }

 private:
  bool have_parted(const Sight& sight) const {
    const Domain& domain = sight.domain();
    std::vector<const BondTable*> tables;
    for (const std::string& family : *of) tables.push_back(domain.find_family(family));
    const std::vector<Index> body = bodies(domain, tables, sight.moment().step);
    std::vector<char> reached(body.size(), 0);
    for (const Index row : domain.set((*faces)[0]))
      reached[static_cast<std::size_t>(body[static_cast<std::size_t>(row)])] = 1;
    const Set& other = domain.set((*faces)[1]);
    return std::none_of(other.begin(), other.end(), [&](Index row) {
      return reached[static_cast<std::size_t>(body[static_cast<std::size_t>(row)])];
    });
  }

  void add_interface(const BondTable& table, std::vector<Real>& row) const {
    const LostArea lost(table, area.view(), damage.view());
    row.push_back(lost.all > 0 ? lost.damaged / lost.all : 0);
    row.push_back(lost.all > 0 ? lost.open / lost.all : 0);
  }
};

}  // namespace beadwork
