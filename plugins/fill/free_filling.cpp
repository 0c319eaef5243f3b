#include <utility>

#include "core/base/random.hpp"
#include "core/base/text.hpp"
#include "plugins/fill/packing_steps.hpp"

namespace beadwork {

/// First step of filling: elements at random places, none overlapping another, until nothing more fits.
/// docs/theory/packing.md
class FreeFilling final : public ElementMaker {
 public:
  static constexpr const char* about =
      "First step of filling: elements at random places without overlap, until nothing more fits";
  Param<Vec3> box{
      this,
      {.name = "box", .unit = "m", .range = positive, .doc = "Extents of the box to be filled", .one_of = "shape"}};
  Param<Vec3> from{this,
                   {.name = "from",
                    .unit = "m",
                    .doc = "Lowest corner of the box, or centre of one end of the cylinder",
                    .fallback = "0 0 0 m"}};
  Param<Real> cylinder_radius{this,
                              {.name = "cylinder-radius",
                               .unit = "m",
                               .range = positive,
                               .doc = "Radius of the cylinder to be filled, from 'from' to 'to'",
                               .one_of = "shape"}};
  Param<Vec3> to{this, {.name = "to", .unit = "m", .doc = "Centre of the other end of the cylinder", .optional = true}};
  Param<std::int64_t> count{this,
                            {.name = "count",
                             .range = {1},
                             .doc = "Number of elements of the finished packing",
                             .knob = Knob::smaller_is_faster,
                             .one_of = "size"}};
  Param<Real> mean_radius{this,
                          {.name = "mean-radius",
                           .unit = "m",
                           .range = positive,
                           .doc = "Mean radius; the number of elements follows",
                           .one_of = "size"}};
  Param<std::string> law{this,
                         {.name = "law",
                          .doc = "How radii are distributed",
                          .fallback = "uniform",
                          .choices = {"uniform", "truncated-gaussian"}}};
  Param<Real> spread{this,
                     {.name = "spread",
                      .range = {0, 1, false, true},
                      .doc = "Radii lie within (1 - spread) and (1 + spread) of their mean",
                      .fallback = "0.25"}};
  Param<Real> deviation{
      this,
      {.name = "deviation",
       .range = positive,
       .doc = "Standard deviation of the Gaussian over the mean, before it is cut; 0.125 where absent",
       .optional = true}};
  Param<std::vector<std::string>> around{
      this,
      {.name = "around", .doc = "Sets that are there already and do not move", .optional = true, .role = Role::set}};

  void check(Complaints& complaints) const override {
    if (cylinder_radius.in_deck() && !to.given())
      complaints.error(cylinder_radius.at(), "a cylinder needs 'to', the centre of its other end");
    if (to.in_deck() && !cylinder_radius.in_deck())
      complaints.error(to.at(), "'to' belongs to a cylinder; a box reaches from 'from' as far as 'box' says");
    if (deviation.in_deck() && *law == "uniform")
      complaints.error(deviation.at(),
                       "'deviation' belongs to law=\"truncated-gaussian\"; a uniform law has its 'spread' only");
  }

  void fill(Domain& domain, const FillJob& job) override {
    packing::Request request;
    if (box.given())
      request.region = packing::Box{*from, *from + *box};
    else
      request.region = packing::Cylinder{*from, *to, *cylinder_radius};
    if (count.given()) request.count = *count;
    if (mean_radius.given()) request.mean_radius = *mean_radius;
    request.dispersion.law = *law == "uniform" ? packing::RadiusLaw::uniform : packing::RadiusLaw::truncated_gaussian;
    request.dispersion.spread = *spread;
    if (deviation.given()) request.dispersion.deviation = *deviation;
    request.seed = own_seed(job.seed);
    request.pause = job.pause;
    request.tell = teller(job, *this, *set);
    const std::set<Index> obstacles = those_around(domain);
    if (around.given()) require_fibres_inside(domain, request.region);
    note_obstacles(domain, obstacles, request.around);
    guarded(*this, [&] {
      packing::Packing packing = packing::free_filling(request);
      for (const std::string& warning : packing.warnings) job.log.warn(warning);
      const Index first = add_spheres(domain, packing.position, packing.radius);
      warn_of_others(domain, first, obstacles, job);
      job.log.say(fmt::format("{}: {} elements, {} still to be placed, {:.1f} s", tag(), packing.position.size(),
                              packing.waiting.size(), packing.seconds));
      const auto rows = static_cast<Index>(packing.position.size());
      begun_ = std::make_shared<PackingInProgress>(PackingInProgress{std::move(packing), *density, first, rows});
      (*job.in_progress)[*set] = begun_;
    });
  }

  void conclude(const FillJob& job) override {
    const auto begun = std::exchange(begun_, nullptr);  // the memory is needed for the run
    const std::size_t placed = begun->packing.position.size(), waiting = begun->packing.waiting.size();
    if (waiting > 0)
      job.log.warn(fmt::format(
          "{}: only {} of {} elements found a place without overlap; <forced-filling set=\"{}\"/> places the rest",
          at().where(), placed, placed + waiting, *set));
  }

 private:
  std::shared_ptr<PackingInProgress> begun_;  // which the later steps go on with

  // Two packings of a deck are not to be twins. The first takes the deck's seed itself, the others draw theirs: numbers
  // below 2^53, so that they can be read in summary.json and given to a deck of that packing alone.
  std::uint64_t own_seed(std::uint64_t seed) const {
    const auto number = parse_number(id().substr(id().rfind('.') + 1));  // "fill.free-filling.2"; the first has none
    if (!number) return seed;
    constexpr std::uint64_t stream = 1000;  // far from those of a packing
    return Random(seed, stream + static_cast<std::uint64_t>(*number)).bits() >> 11;
  }

  /// Elements that do not move. Sets may overlap.
  std::set<Index> those_around(const Domain& domain) const {
    std::set<Index> rows;
    if (!around.given()) return rows;
    for (const std::string& name : *around) {
      if (!domain.sets().contains(name))
        refuse(around.at(name), fmt::format("set '{}' is made only later: put what makes it in front of this", name));
      rows.insert(domain.set(name).begin(), domain.set(name).end());
    }
    return rows;
  }

  static void note_obstacles(const Domain& domain, const std::set<Index>& rows, packing::Obstacles& obstacles) {
    const auto position = domain.elements().column("position").view<Vec3>();
    const auto radius = domain.elements().column("radius").view<Real>();
    for (const Index row : rows) {
      obstacles.position.push_back(position[row]);
      obstacles.radius.push_back(radius[row]);
    }
  }

  void warn_of_others(const Domain& domain, Index first, const std::set<Index>& known, const FillJob& job) const {
    constexpr Real much = 0.01;  // of the sum of the radii
    if (const Real into = deepest_into_others(domain, first, known, job.pause); into > much)
      job.log.warn(
          fmt::format("{}: elements of '{}' stand inside others that are there already, by up to {:.2g} of the sum "
                      "of their radii: 'around' names sets that are to be packed around",
                      at().where(), *set, into));
  }

  // Beyond the ends of a fibre the box may end; across it, there must be room for the solid around it.
  void require_fibres_inside(const Domain& domain, const packing::Region& region) const {
    const packing::Walls walls(region);
    const auto position = domain.elements().column("position").view<Vec3>();
    const auto radius = domain.elements().column("radius").view<Real>();
    for (const std::string& name : *around) {
      const auto listed = domain.pairs().find(name);
      if (listed == domain.pairs().end()) continue;
      for (const auto& [first, second] : listed->second) {
        const Vec3 along = (position[second] - position[first]).normalized();
        for (std::size_t w = 0; w < walls.size(); ++w) {
          const packing::WallView wall = walls.view(w, position[first]);
          constexpr Real crossing = 0.5;  // |cos| between the fibre and a wall's normal
          if (std::abs(wall.inward.dot(along)) > crossing || wall.distance >= radius[first] * (1 - 1e-9)) continue;
          const Vec3 x = position[first];
          refuse(
              around.at(name),
              fmt::format("a fibre of set '{}' leaves the {} across its axis, at {:.6g} {:.6g} {:.6g} m, by {:.3g} m: "
                          "move it, or make the region wider",
                          name, packing::describe(region), x.x(), x.y(), x.z(), radius[first] - wall.distance));
        }
      }
    }
  }
};

}  // namespace beadwork
