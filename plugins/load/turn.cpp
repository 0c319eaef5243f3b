#include "core/domain/vocabulary.hpp"
#include "plugins/load/driving.hpp"

namespace beadwork {

/// Turns a set about an axis with a prescribed angular velocity: as one rigid body, or each element about its own
/// centre.
class Turn final : public DrivingLoad {
 public:
  static constexpr const char* about =
      "Turns a set about an axis with a prescribed angular velocity: as one body, or each element about its own centre";
  Param<Vec3> centre{this,
                     {.name = "about",
                      .unit = "m",
                      .doc = "A point of the axis: the set goes round it as one rigid body, in all its places and "
                             "turns; where absent each element turns about its own centre, and its place is free",
                      .optional = true}};
  Param<std::string> along{
      this,
      {.name = "along",
       .doc = "Places along the axis of such a body: held, or free, for <pull> or <hold> to see to",
       .fallback = "held",
       .choices = {"held", "free"}}};

  Reads<Vec3> position{this, field::position};
  Keeps<Vec3> spin{this, field::spin};
  Keeps<Vec3> from{this, {"from", On::elements, "m", "Place when the turn began"}};
  Keeps<Real> begun{this, {"begun", On::scene, "1", "1 once the turn has begun"}};

  Turn() : DrivingLoad({"Angular velocity", "1/s", "2 rad/s * sin(2*pi * t / 1 ms)", "0 s 0 rad/s, 1 ms 2 rad/s"}) {
    from.own();  // each from where it began
  }

  void check(Complaints& complaints) const override {
    if (*along == "free" && !centre.given())
      complaints.error(along.at(), "'along' is of a body that turns about a point: give 'about'");
    DrivingLoad::check(complaints);
  }

  // Elements that go round need no spins where no law reads turns; those that only spin do.
  void choose() override {
    spin.want(!centre.given());
    from.want(centre.given());
    begun.want(centre.given());
    position.want(centre.given());
  }

  // A turn that stands in several stages goes on.
  void start(Domain& domain) override {
    if (!from || begun[0] != 0) return;
    begun[0] = 1;
    for (const Index row : domain.set(*set)) from.set(row, position[row]);
  }

  std::vector<Constraint> constraints() const override {
    Constraint c;
    c.by = id();
    c.set = *set;
    c.axis = 3 + (*axis)[0] - 'x';
    if (centre.given()) c.body.emplace(*centre, column_name(from), *along == "held");
    drive(c);
    return {c};
  }
};

}  // namespace beadwork
