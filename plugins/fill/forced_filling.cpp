#include "plugins/fill/packing_steps.hpp"

namespace beadwork {

/// Second step of filling: the rest is forced in with overlap and all are re-arranged, until the coordination number is
/// reached.   docs/theory/packing.md
class ForcedFilling final : public PackingStep {
 public:
  static constexpr const char* about =
      "Second step of filling: forces the rest in and re-arranges, until the coordination number is reached";
  Param<Real> coordination{this,
                           {.name = "coordination",
                            .range = positive,
                            .doc = "Contacts of an element, mean over those that are counted",
                            .fallback = "6.2"}};
  Param<std::string> counted{this,
                             {.name = "counted",
                              .doc = "Which elements are counted: all, or those in the bulk, farther than 3 mean radii "
                                     "from walls and obstacles, where walls take no contacts away",
                              .fallback = "all",
                              .choices = {"all", "bulk"}}};
  Param<std::string> radii{
      this,
      {.name = "radii",
       .doc =
           "as-drawn: all grow or shrink by one factor; balanced: before that those near obstacles are adapted, within "
           "their law's range, until elements are pressed alike, also in rooms that are hardly an element wide",
       .fallback = "as-drawn",
       .choices = {"as-drawn", "balanced"}}};
  Param<Real> tolerance{this,
                        {.name = "tolerance",
                         .range = {0, 1, true, true},
                         .doc = "Largest overlap over the sum of radii at which an element is put in",
                         .fallback = "0.3",
                         .knob = Knob::larger_is_faster}};

 protected:
  void go_on(packing::Packing& packing) override {
    packing::forced_filling(packing, {*coordination, *tolerance, *counted == "bulk", *radii == "balanced"});
  }
};

}  // namespace beadwork
