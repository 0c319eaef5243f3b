#pragma once
// What the curves of cracks are drawn against: the displacement of a driven set, or time.

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "core/base/text.hpp"
#include "core/plugin/kinds.hpp"

namespace beadwork {

class Against {
 public:
  explicit Against(Watcher* owner)
      : set_{owner,
             {.name = "against",
              .doc = "Set whose driven displacement is the abscissa; time where absent",
              .optional = true,
              .role = Role::set}} {}

  /// Name of the column on the abscissa.
  const char* abscissa() const { return set_.given() ? "displacement" : "time"; }

  void check(std::span<const Constraint> constraints, Complaints& complaints) const {
    if (!set_.given()) return;
    std::set<std::string> driven;
    for (const Constraint& c : constraints)
      if (c.pulls()) driven.insert(c.set);
    if (!driven.contains(*set_))
      complaints.error(set_.at(),
                       fmt::format("'against' names set '{}', which nothing in <load> drives while it looks{}", *set_,
                                   did_you_mean(*set_, {driven.begin(), driven.end()})));
  }

  /// How far the set has been driven [m]; 0 where there is none.
  Real displacement(const Sight& sight) const {
    if (!set_.given()) return 0;
    for (const Constraint& c : sight.constraints())
      if (c.pulls() && c.set == *set_) return std::abs(c.at(sight.moment().time).displacement);
    return 0;
  }

 private:
  Param<std::string> set_;
};

}  // namespace beadwork
