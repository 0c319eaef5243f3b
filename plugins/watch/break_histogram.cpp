#include <algorithm>

#include "core/plugin/kinds.hpp"
#include "plugins/watch/broken.hpp"

namespace beadwork {

/// Histogram of the places of breaks along an axis: at each moment as many rows as there are classes.
class BreakHistogram final : public Watcher {
 public:
  static constexpr const char* about =
      "Histogram of the places of breaks along an axis: at the end, and at each moment asked for, a row for each class";
  Param<std::vector<std::string>> of{
      this, {.name = "of", .doc = "Families of the bonds that are counted", .role = Role::family}};
  Param<std::string> axis{this,
                          {.name = "axis", .doc = "Axis along which places are told", .choices = {"x", "y", "z"}}};
  Param<Real> from{this, {.name = "from", .unit = "m", .doc = "Where the first class begins", .fallback = "0 m"}};
  Param<Real> to{this, {.name = "to", .unit = "m", .doc = "Where the last class ends"}};
  Param<std::int64_t> classes{this,
                              {.name = "classes", .range = {1, 10000}, .doc = "Number of classes", .fallback = "28"}};
  Param<std::string> name{this, {.name = "name", .doc = "Name of the curve and of its file", .fallback = "breaks"}};
  Curve curve{this,
              name,
              {.columns = {{"place", "m"}, {"breaks", "1"}, {"share", "1"}},
               .title = "Breaks by place",
               .x = "place",
               .y = {"breaks"},
               .kind = "histogram"}};

  /// Where the deck gives no cadence, at the end alone: a histogram is not a course.
  bool wants(const Moment& moment) const override { return every.in_deck() && Watcher::wants(moment); }

  void check(Complaints& complaints) const override {
    if (!(*to > *from)) complaints.error(to.at(), "'to' must lie beyond 'from'");
  }

  void look(Sight& sight) override {
    const Broken broken(sight.domain(), *of, (*axis)[0] - 'x');
    std::vector<Real> counts(static_cast<std::size_t>(*classes), 0);
    const Real width = (*to - *from) / static_cast<Real>(*classes);
    for (const Real place : broken.places)
      if (const Real k = std::floor((place - *from) / width); k >= 0 && k < static_cast<Real>(*classes))
        counts[static_cast<std::size_t>(k)] += 1;
    const auto all = static_cast<Real>(broken.places.size());
    for (std::size_t k = 0; k < counts.size(); ++k)
      curve.row({*from + (static_cast<Real>(k) + 0.5) * width, counts[k], all > 0 ? counts[k] / all : 0});
  }
};

}  // namespace beadwork
