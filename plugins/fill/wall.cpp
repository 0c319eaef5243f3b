#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "core/base/failure.hpp"
#include "core/base/memory.hpp"
#include "core/domain/surface.hpp"
#include "core/io/stl.hpp"
#include "plugins/fill/spheres.hpp"

namespace beadwork {

/// A rigid body that elements touch by contacts.   docs/theory/contact.md
class Wall final : public SphereFiller {
 public:
  static constexpr const char* about =
      "Rigid wall: plane, disc, box, cylinder, sphere, or a surface of triangles. Contacts push elements off it; it "
      "stands "
      "still along the axes along which no load moves it";
  Param<std::string> set{this,
                         {.name = "set",
                          .doc = "Name of the wall, as a set; loads move several walls of one name alike",
                          .role = Role::makes_set}};
  Param<std::string> shape{this,
                           {.name = "shape",
                            .doc = "plane: a half-space; disc: thin, of both sides; box, cylinder, sphere: full, or "
                                   "hollow with side=\"inside\"; surface: the triangles of a file",
                            .choices = {"plane", "disc", "box", "cylinder", "sphere", "surface"}}};
  Param<Vec3> at{
      this,
      {.name = "at",
       .unit = "m",
       .doc = "A point of the plane; the centre of disc, box and sphere, and of one end of a cylinder; where "
              "the origin of a file comes to lie. The wall turns about it"}};
  Param<Vec3> normal{this,
                     {.name = "normal",
                      .doc = "Of plane and disc, of any length: from the wall to where the elements are",
                      .optional = true}};
  Param<Real> radius{
      this,
      {.name = "radius", .unit = "m", .range = positive, .doc = "Of disc, cylinder and sphere", .optional = true}};
  Param<Vec3> to{this, {.name = "to", .unit = "m", .doc = "Centre of the other end of a cylinder", .optional = true}};
  Param<Vec3> size{
      this,
      {.name = "size", .unit = "m", .range = positive, .doc = "Edges of a box along x, y and z", .optional = true}};
  Param<std::string> side{
      this,
      {.name = "side",
       .doc = "On which elements are, of box, cylinder and sphere, which are full where it is absent; "
              "of a closed surface, whose triangles go round counterclockwise seen from outside; one "
              "without 'side' is a shell that elements touch on both",
       .optional = true,
       .choices = {"outside", "inside"}}};
  Param<std::string> ends{
      this, {.name = "ends", .doc = "Of a hollow cylinder", .optional = true, .choices = {"closed", "open"}}};
  Param<std::string> file{
      this, {.name = "file", .doc = "STL of a surface, of text or binary", .optional = true, .role = Role::file}};
  Param<Real> unit{
      this,
      {.name = "unit", .unit = "m", .range = positive, .doc = "What 1 in the file is: 1 mm, say", .optional = true}};
  Param<Real> own_mass{this,
                       {.name = "mass",
                        .unit = "kg",
                        .range = positive,
                        .doc = "With a mass forces move it along the axes along which no load does; without, it stands "
                               "still there",
                        .optional = true}};
  Param<Real> own_inertia{this,
                          {.name = "inertia",
                           .unit = "kg.m2",
                           .range = positive,
                           .doc = "The same for turning: moment of inertia about any axis through 'at'; wants 'mass'",
                           .optional = true}};

  bool makes_walls() const override { return true; }

  void check(Complaints& complaints) const override {
    struct Use {
      const ParamBase* param;
      std::vector<std::string> needed_by, taken_by;
    };
    const std::vector<Use> uses = {{&normal, {"plane", "disc"}, {}},
                                   {&radius, {"disc", "cylinder", "sphere"}, {}},
                                   {&to, {"cylinder"}, {}},
                                   {&size, {"box"}, {}},
                                   {&side, {}, {"box", "cylinder", "sphere", "surface"}},
                                   {&ends, {}, {"cylinder"}},
                                   {&file, {"surface"}, {}},
                                   {&unit, {"surface"}, {}}};
    const auto has = [&](const std::vector<std::string>& shapes) {
      return std::find(shapes.begin(), shapes.end(), *shape) != shapes.end();
    };
    for (const auto& [param, needed_by, taken_by] : uses) {
      const std::string& name = param->info().name;
      if (has(needed_by) && !param->in_deck())
        complaints.error(shape.at(), fmt::format("a {} needs '{}': {}", *shape, name, param->info().doc));
      if (!has(needed_by) && !has(taken_by) && param->in_deck())
        complaints.error(param->at(), fmt::format("a {} has no '{}'", *shape, name));
    }
    if (normal.given() && !(normal->norm() > 0))
      complaints.error(normal.at(), "'normal' has no length, so no direction");
    if (to.given() && !((*to - *at).norm() > 0)) complaints.error(to.at(), "'to' is where 'at' is");
    if (ends.given() && !is_hollow()) complaints.error(ends.at(), "'ends' belongs to side=\"inside\"");
    if (own_inertia.given() && !own_mass.in_deck())
      complaints.error(own_inertia.at(), "'inertia' wants 'mass' beside it");
  }

  std::vector<Constraint> constraints() const override {
    std::vector<Constraint> all;
    for (int axis = own_mass.given() ? 3 : 0; axis < (own_inertia.given() ? 3 : 6); ++axis) {
      Constraint c;
      c.by = id();
      c.set = *set;
      c.axis = axis;
      c.motion = [](Real) { return PrescribedMotion{0, 0, 0}; };
      all.push_back(c);
    }
    return all;
  }

  void fill(Domain& domain, const FillJob& job) override {
    const std::vector<Facet> parts = facets(job);
    const Index row = add_rows(domain, *set, 1);
    bind(domain);
    domain.elements()
        .column("position")
        .view<Vec3>()
        .set(row, *shape == "cylinder" ? Vec3((*at + *to) / 2) : Vec3(*at));
    domain.elements().column("radius").view<Real>()[row] = 0;
    if (mass) mass[row] = own_mass.given() ? *own_mass : no_mass;
    if (inertia) inertia[row] = own_inertia.given() ? *own_inertia : no_mass;
    domain.walls().add(row, own_mass.given(), parts);
  }

 private:
  bool is_hollow() const { return side.given() && *side == "inside"; }

  // In the frame of the wall, whose origin is 'at'.
  std::vector<Facet> facets(const FillJob& job) const {
    const Vec3 here = Vec3::Zero();
    if (*shape == "plane") return {Facet::of(FacetKind::plane, here, normal->normalized())};
    if (*shape == "disc") return {Facet::of(FacetKind::disc, here, normal->normalized(), *radius)};
    if (*shape == "sphere")
      return {Facet::of(is_hollow() ? FacetKind::hollow_sphere : FacetKind::sphere, here, here, *radius)};
    if (*shape == "box") return box();
    if (*shape == "cylinder") return cylinder();
    return surface(job);
  }

  std::vector<Facet> box() const {
    const Vec3 half = *size / 2;
    if (!is_hollow()) return {Facet::of(FacetKind::box, Vec3::Zero(), half)};
    std::vector<Facet> sides;
    for (int axis = 0; axis < 3; ++axis)
      for (const Real sign : {-1.0, 1.0}) {
        const Vec3 out = sign * Vec3::Unit(axis);
        sides.push_back(Facet::of(FacetKind::plane, half[axis] * out, -out));
      }
    return sides;
  }

  // Its place is its middle.
  std::vector<Facet> cylinder() const {
    const Vec3 along = (*to - *at).normalized(), from = (*at - *to) / 2;
    const Real length = (*to - *at).norm();
    if (!is_hollow()) return {Facet::of(FacetKind::cylinder, from, along, *radius, length)};
    if (ends.given() && *ends == "open") return {Facet::of(FacetKind::pipe, from, along, *radius, length)};
    return {Facet::of(FacetKind::hollow_cylinder, from, along, *radius, length),
            Facet::of(FacetKind::plane, from, along), Facet::of(FacetKind::plane, -from, -along)};
  }

  std::vector<Facet> surface(const FillJob& job) const try {
    std::vector<Triangle> triangles = read_stl(*file);
    for (Triangle& triangle : triangles)
      for (Vec3& corner : triangle) corner *= *unit;
    constexpr Real bytes = 2000;  // with its share of edges and corners, while these are looked for and in checkpoints
    if (const std::string why = why_no_memory(static_cast<Real>(triangles.size()), "triangles", bytes); !why.empty())
      refuse(file.at(), why);
    const Sides sides = !side.given() ? Sides::both : is_hollow() ? Sides::back : Sides::front;
    std::vector<Facet> parts = facets_of(triangles, sides);
    const auto count = [&](FacetKind kind) {
      return std::count_if(parts.begin(), parts.end(), [&](const Facet& part) { return part.kind == kind; });
    };
    Eigen::AlignedBox3d extent;
    for (const Triangle& triangle : triangles)
      for (const Vec3& corner : triangle) extent.extend(Eigen::Vector3d(corner + *at));
    job.log.say(fmt::format(
        "wall '{}': {} of {} triangles, {} edges and {} corners that stand out, from ({:.4g} {:.4g} "
        "{:.4g}) to ({:.4g} {:.4g} {:.4g}) m",
        *set, count(FacetKind::face), triangles.size(), count(FacetKind::edge), count(FacetKind::corner),
        extent.min().x(), extent.min().y(), extent.min().z(), extent.max().x(), extent.max().y(), extent.max().z()));
    if (!side.given() && is_closed(triangles))
      job.log.warn(
          fmt::format("{}: the surface is closed, and without 'side' a shell: elements that are thicker than it "
                      "are pushed by its far side too; side=\"outside\" makes it full",
                      file.at().where()));
    return parts;
  } catch (const std::invalid_argument& wrong) {
    refuse(file.at(), fmt::format("\"{}\": {}", *file, wrong.what()));
  }
};

}  // namespace beadwork
