#include "core/plugin/kinds.hpp"

namespace beadwork {

/// The balance  work = stored + kinetic + dissipated  over time, with what is left over.
class EnergyLedger final : public Watcher {
 public:
  static constexpr const char* about = "Energy balance over time: work, stored, kinetic and dissipated energy, and the residual";
  Param<std::string> name{this, {.name = "name", .doc = "Name of the curve and of its file", .fallback = "energy"}};
  Keeps<Real> initial{this, {"initial", On::scene, "J", "Energy at the first look: it was there before any work was done"}};
  Keeps<Real> started{this, {"started", On::scene, "1", "1 once the first look has been taken"}};

  void look(Sight& sight) override {
    Sums sums;
    sight.energies(sums);
    const Real inside = sums.stored_ + sums.kinetic_ + sums.dissipated_ - sums.work_;
    if (started[0] == 0) {
      initial[0] = inside;
      started[0] = 1;
    }
    const Real row[] = {sums.work_, sums.stored_, sums.kinetic_, sums.dissipated_, initial[0] - inside};
    sight.curve({.name = *name,
                 .columns = {{"work", "J"}, {"stored", "J"}, {"kinetic", "J"}, {"dissipated", "J"}, {"residual", "J"}},
                 .title = "Energy balance",
                 .x = "time",
                 .y = {"work", "stored", "kinetic", "dissipated", "residual"},
                 .references = {},
                 .kind = "ledger"})
        .row(row);
  }

 private:
  struct Sums final : EnergySink {
    void work(const std::string&, Real joule) override { work_ += joule; }
    void stored(const std::string&, Real joule) override { stored_ += joule; }
    void kinetic(Real joule) override { kinetic_ += joule; }
    void dissipated(const std::string&, Real joule) override { dissipated_ += joule; }
    Real work_ = 0, stored_ = 0, kinetic_ = 0, dissipated_ = 0;
  };
};

}  // namespace beadwork
