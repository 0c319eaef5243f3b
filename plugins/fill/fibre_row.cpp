#include "plugins/fill/fibre_maker.hpp"

namespace beadwork {

/// One straight fibre: a row of elements that overlap.   Section 4.1, Fig 17; docs/theory/packing.md
class FibreRow final : public FibreMaker {
 public:
  static constexpr const char* about = "One straight fibre as a row of elements that overlap, its neighbours listed";
  Param<Vec3> from{this, {.name = "from", .unit = "m", .doc = "One end of the fibre's axis"}};
  Param<Vec3> to{this, {.name = "to", .unit = "m", .doc = "The other end"}};

  void fill(Domain& domain, const FillJob& job) override {
    if (!((*to - *from).norm() > 0)) refuse(to.at(), "'to' is the place of 'from': a fibre needs a direction");
    const FibreLine row = row_between(*from, *to);
    require_room(domain, row.count);
    make(domain, {&row, 1});
    job.report(fmt::format(R"({{"set":"{}","step":"{}","elements":{},"fibres":1,{}}})", *set, tag(), row.count,
                           row_json(row)));
    job.log.say(fmt::format("{}: {}", tag(), row_words(row)));
  }
};

}  // namespace beadwork
