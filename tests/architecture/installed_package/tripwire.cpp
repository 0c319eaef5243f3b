#include <stdexcept>

#include "core/plugin/kinds.hpp"

namespace beadwork {

/// Throws at a given step, as a plugin with a mistake might.
class Tripwire final : public Watcher {
 public:
  static constexpr const char* about = "Throws at a given step";
  Param<std::int64_t> at_step{this, {.name = "at-step", .doc = "Step at which it throws"}};

  void look(Sight& sight) override {
    if (sight.moment().step >= *at_step) throw std::runtime_error("the wire was touched");
  }
};

}  // namespace beadwork
