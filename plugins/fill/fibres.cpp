#include <algorithm>
#include <limits>

#include "core/base/text.hpp"
#include "core/packing/packing.hpp"
#include "core/packing/parallel_discs.hpp"
#include "plugins/fill/fibre_maker.hpp"

namespace beadwork {

/// Parallel fibres at random places of a box.   Section 5, Figs 29, 30; docs/theory/packing.md
class Fibres final : public FibreMaker {
 public:
  static constexpr const char* about =
      "Parallel fibres at random places of a box, each a row of elements that overlap, their neighbours listed";
  Param<Vec3> box{this,
                  {.name = "box", .unit = "m", .range = positive, .doc = "Extents of the box; fibres cross all of it"}};
  Param<Vec3> from{this, {.name = "from", .unit = "m", .doc = "Lowest corner of the box", .fallback = "0 0 0 m"}};
  Param<std::string> axis{this,
                          {.name = "axis", .doc = "Axis that the fibres are parallel to", .choices = {"x", "y", "z"}}};
  Param<Real> volume_fraction{
      this,
      {.name = "volume-fraction",
       .range = {0, 0.9, true, true},
       .doc = "Share V_f of the box that the fibres take up; the number of fibres is the nearest to it",
       .one_of = "number"}};
  Param<std::int64_t> number{this, {.name = "number", .range = {1}, .doc = "Number of fibres", .one_of = "number"}};
  Param<Real> gap{
      this, {.name = "gap", .unit = "m", .range = not_negative, .doc = "Least distance between two fibres' surfaces"}};
  Param<Real> margin{this,
                     {.name = "margin",
                      .unit = "m",
                      .range = not_negative,
                      .doc = "Least distance of a fibre's surface from the box's faces beside it; 'gap' where absent",
                      .optional = true}};
  Param<std::int64_t> seed{
      this,
      {.name = "seed", .range = {0}, .doc = "Seed of their places; that of the scene where absent", .optional = true}};

  void fill(Domain& domain, const FillJob& job) override {
    const std::vector<packing::Place> places = placed(job);
    std::vector<FibreLine> rows;
    const int along = axis_number(), u = (along + 1) % 3, v = (along + 2) % 3;
    for (const packing::Place& place : places) {
      Vec3 start = *from, end = *from + *box;
      start[u] = end[u] = place[0], start[v] = end[v] = place[1];
      rows.push_back(row_between(start, end));
    }
    require_room(domain, rows.size() * rows.front().count);
    make(domain, rows);
    tell(places, rows.front(), job);
  }

 private:
  int axis_number() const { return (*axis)[0] - 'x'; }
  Real cross_section() const { return box->prod() / box->coeff(axis_number()); }
  Real fibre_section() const { return std::numbers::pi * *radius * *radius; }

  std::vector<packing::Place> placed(const FillJob& job) const {
    const int u = (axis_number() + 1) % 3, v = (axis_number() + 2) % 3;
    const Real inset = *radius + (margin.given() ? *margin : *gap);
    packing::Discs discs{.low = {from->coeff(u) + inset, from->coeff(v) + inset},
                         .high = {from->coeff(u) + box->coeff(u) - inset, from->coeff(v) + box->coeff(v) - inset},
                         .distance = 2 * *radius + *gap,
                         .count = fibres_wanted(),
                         .seed = seed.given() ? static_cast<std::uint64_t>(*seed) : job.seed,
                         .pause = job.pause};
    try {
      return packing::place_discs(discs);
    } catch (const std::invalid_argument& refused) {
      refuse(box.at(), refused.what());
    } catch (const packing::PackingFailure& failed) {
      refuse((number.given() ? static_cast<const ParamBase&>(number) : volume_fraction).at(),
             fmt::format("{}; one fibre is a volume fraction of {:.4g} of this box", failed.what(),
                         fibre_section() / cross_section()));
    }
  }

  std::size_t fibres_wanted() const {
    if (number.given()) return static_cast<std::size_t>(*number);
    const Real wanted = *volume_fraction * cross_section() / fibre_section();
    if (!(wanted >= 0.5))
      refuse(volume_fraction.at(),
             fmt::format("a volume fraction of {} is less than half a fibre in this box: one has {:.4g}",
                         volume_fraction.text(), fibre_section() / cross_section()));
    return static_cast<std::size_t>(std::lround(wanted));
  }

  /// Least and mean distance from a fibre's surface to that of the nearest other.
  std::pair<Real, Real> gaps(std::span<const packing::Place> places) const {
    Real least = std::numeric_limits<Real>::infinity(), sum = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      Real nearest = std::numeric_limits<Real>::infinity();
      for (std::size_t j = 0; j < places.size(); ++j)
        if (i != j) nearest = std::min(nearest, (places[i] - places[j]).norm() - 2 * *radius);
      least = std::min(least, nearest);
      sum += nearest;
    }
    return {least, sum / static_cast<Real>(places.size())};
  }

  void tell(std::span<const packing::Place> places, const FibreLine& row, const FillJob& job) const {
    const Real share = static_cast<Real>(places.size()) * fibre_section() / cross_section();
    const bool several = places.size() > 1;
    const auto [least, mean] = several ? gaps(places) : std::pair<Real, Real>{0, 0};
    const std::string gaps_json =
        several ? fmt::format(R"("least_gap":{:.6g},"mean_gap_to_the_nearest":{:.6g},)", least, mean) : "";
    job.report(fmt::format(R"({{"set":"{}","step":"{}","elements":{},"fibres":{},"volume_fraction":{:.6g},{}{}}})",
                           *set, tag(), places.size() * row.count, places.size(), share, gaps_json, row_json(row)));
    job.log.say(fmt::format(
        "{}: {} fibres of {}; volume fraction {:.4g}{}", tag(), places.size(), row_words(row), share,
        several ? fmt::format(", nearest ones {:.4g} m apart at least, {:.4g} m on average", least, mean) : ""));
  }
};

}  // namespace beadwork
