#include "plugins/fill/packing_steps.hpp"

namespace beadwork {

/// Third step of filling: overlaps are relaxed until hardly any are left.   docs/theory/packing.md
class Relaxation final : public PackingStep {
 public:
  static constexpr const char* about =
      "Third step of filling: relaxes overlaps until the largest is below a given share";
  Param<Real> overlap{this,
                      {.name = "overlap",
                       .range = {0, 1, true, true},
                       .doc = "Largest overlap over the sum of radii that may be left, walls included",
                       .fallback = "1e-7",
                       .knob = Knob::larger_is_faster}};
  Param<Real> radius_change{this,
                            {.name = "radius-change",
                             .range = {0, 0.2},
                             .doc = "Share by which each radius may change, which lets the packing reach a higher "
                                    "coordination; 0: all by one common factor",
                             .fallback = "0.03"}};

 protected:
  void go_on(packing::Packing& packing) override { packing::relaxation(packing, {*overlap, *radius_change}); }
};

}  // namespace beadwork
