#include "core/plugin/kinds.hpp"

namespace beadwork {

/// The balance  initial + work = stored + kinetic + dissipated  over time, with what is left over.
class EnergyLedger final : public Watcher {
 public:
  static constexpr const char* about =
      "Energy balance over time: work, stored, kinetic and dissipated energy, and the residual";
  Param<std::string> name{this, {.name = "name", .doc = "Name of the curve and of its file", .fallback = "energy"}};
  Curve curve{this,
              name,
              {.columns = {{"work", "J"}, {"stored", "J"}, {"kinetic", "J"}, {"dissipated", "J"}, {"residual", "J"}},
               .title = "Energy balance",
               .x = "time",
               .y = {"work", "stored", "kinetic", "dissipated", "residual"},
               .kind = "ledger"}};

  void look(Sight& sight) override {
    EnergySums sums;
    sight.energies(sums);
    curve.row({sums.worked, sums.in_bonds, sums.in_motion, sums.taken, sight.initial_energy() - sums.beyond_work()});
  }
};

}  // namespace beadwork
