#include "core/mechanics/ramp.hpp"

#include <algorithm>
#include <stdexcept>

namespace beadwork {

VelocityTable::VelocityTable(std::vector<Row> rows) : rows_(std::move(rows)), travelled_(rows_.size(), 0) {
  if (rows_.empty()) throw std::invalid_argument("a velocity table needs at least one row");
  for (std::size_t i = 1; i < rows_.size(); ++i) {
    const Real span = rows_[i].time - rows_[i - 1].time;
    if (!(span > 0)) throw std::invalid_argument("the times of a velocity table must increase");
    travelled_[i] = travelled_[i - 1] + 0.5 * span * (rows_[i - 1].velocity + rows_[i].velocity);
  }
}

PrescribedMotion VelocityTable::at(Real t) const {
  const auto next =
      std::upper_bound(rows_.begin(), rows_.end(), t, [](Real time, const Row& row) { return time < row.time; });
  if (next == rows_.begin()) return {(t - rows_[0].time) * rows_[0].velocity, rows_[0].velocity, 0};
  const std::size_t i = next - rows_.begin() - 1;
  const Real since = t - rows_[i].time;
  if (next == rows_.end()) return {travelled_[i] + since * rows_[i].velocity, rows_[i].velocity, 0};
  const Real slope = (next->velocity - rows_[i].velocity) / (next->time - rows_[i].time);
  return {travelled_[i] + since * (rows_[i].velocity + 0.5 * slope * since), rows_[i].velocity + slope * since, slope};
}

// The turning points are rows, and where a line between two of them crosses zero.
Real VelocityTable::reach() const {
  if (rows_.back().velocity != 0) return std::numeric_limits<Real>::infinity();
  Real low = 0, high = 0;
  const auto visit = [&](Real displacement) { low = std::min(low, displacement), high = std::max(high, displacement); };
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    visit(travelled_[i]);
    if (i == 0 || rows_[i - 1].velocity * rows_[i].velocity >= 0) continue;
    const Real share = rows_[i - 1].velocity / (rows_[i - 1].velocity - rows_[i].velocity);
    visit(at(rows_[i - 1].time + share * (rows_[i].time - rows_[i - 1].time)).displacement);
  }
  return high - low;
}

}  // namespace beadwork
