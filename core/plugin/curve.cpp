#include "core/plugin/curve.hpp"

#include <stdexcept>

#include "core/plugin/watcher.hpp"

namespace beadwork {

Curve::Curve(Watcher* owner, const Param<std::string>& name, CurvePlan declared)
    : plan(std::move(declared)), name_(name) {
  owner->curves_.push_back(this);
}

void Curve::row(std::span<const Real> values) const {
  if (!sink_) throw std::logic_error("a curve has rows only while a run records");
  sink_->row(*name_, plan, values);
}

}  // namespace beadwork
