#include "workbench/law/response.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace beadwork::law {

namespace {

constexpr Real nothing = 1e-9;  // of the peak: what is left of a bond that has failed

std::vector<Real> copy(std::span<const Real> values, std::size_t rows) {
  std::vector<Real> out(values.begin(), values.end());
  out.resize(rows, 0);
  return out;
}

// How far an end goes for a unit of s.
Real factor_of(const Mode& mode, std::size_t end) {
  Real factor = 0;
  for (std::size_t axis = 0; axis < 6; ++axis) factor += mode.moves[6 * end + axis];  // one of them moves, or none
  return factor;
}

std::size_t peak_row(const Response& response) {
  std::size_t peak = 0;
  for (std::size_t row = 0; row < response.rows(); ++row)
    if (std::abs(response.load[row]) > std::abs(response.load[peak])) peak = row;
  return peak;
}

// Where the response is still straight, and no longer feels the round-off of places.
Real first_stiffness(const Response& response, Real motion) {
  for (std::size_t row = 0; row < response.rows(); ++row)
    if (std::abs(response.motion[row]) >= motion && motion > 0) return response.load[row] / response.motion[row];
  return 0;
}

// The first row that bears nothing is known, and failure lies between it and the one before: at that one where it broke
// there, and where it softens to nothing, on the straight line of the last two.
Real failure_before(const Response& response, std::size_t row, std::size_t peak) {
  const auto& s = response.motion;
  const auto& f = response.load;
  if (row < peak + 2) return s[peak];
  const Real fallen = f[row - 2] - f[row - 1];
  const Real left = fallen != 0 ? f[row - 1] / fallen * (s[row - 1] - s[row - 2]) : 0;
  const Real at = s[row - 1] + left;
  return std::abs(at) >= std::abs(s[row - 1]) && std::abs(at) <= std::abs(s[row]) ? at : s[row];
}

}  // namespace

// What does work on s is the load of each end, as often as that end goes with s.
Response response_of(const Outcome& outcome, const Mode& mode) {
  const char* motion = mode.is_turn() ? "turn" : "displacement";
  const char* load = mode.is_turn() ? "torque" : "force";
  const std::size_t rows = outcome.column("second", motion).size();
  Response response{copy(outcome.column("second", motion), rows), std::vector<Real>(rows, 0),
                    copy(outcome.column("energy", "work"), rows), copy(outcome.column("energy", "stored"), rows),
                    copy(outcome.column("energy", "dissipated"), rows)};
  for (Real& each : response.motion) each /= factor_of(mode, 1);
  for (const auto& [end, curve] : {std::pair{0, "first"}, std::pair{1, "second"}}) {
    const std::vector<Real> loads = copy(outcome.column(curve, load), rows);
    for (std::size_t row = 0; row < rows; ++row)
      response.load[row] += factor_of(mode, static_cast<std::size_t>(end)) * loads[row];
  }
  return response;
}

Found found_in(const Response& search, Real scale) {
  Found found;
  if (search.rows() == 0) return found;
  const std::size_t peak = peak_row(search), last = search.rows() - 1;
  found.peak = search.load[peak];
  found.peak_at = search.motion[peak];
  if (found.peak == 0) return found;
  found.stiffness = first_stiffness(search, std::min(1e-3 * std::abs(found.peak_at), 1e-5 * scale));
  if (std::abs(found.stiffness) < 1e-6 * std::abs(found.peak / found.peak_at)) found.stiffness = 0;  // of second order
  found.softens = std::abs(search.load[last]) < 0.999 * std::abs(found.peak);
  std::size_t row = last + 1;
  while (row > peak && std::abs(search.load[row - 1]) <= nothing * std::abs(found.peak)) --row;
  if (row <= last) found.failed_at = failure_before(search, row, peak);
  return found;
}

std::vector<Real> amplitudes(const Found& found, const Mode& mode, const Pair& pair) {
  const Real peak = found.peak_at;
  if (!found.softens) {
    const Real whole = mode.sign * mode.show * pair.scale(mode);
    return {0.25 * whole, 0.5 * whole, 0.75 * whole, whole};
  }
  const Real end = found.failed_at ? *found.failed_at : mode.sign * mode.look * pair.scale(mode);
  const Real beyond = found.failed_at ? 1.1 * end : end;
  if (peak / end > 0.9) return {0.3 * peak, 0.6 * peak, 0.9 * peak, beyond};  // it breaks at its peak
  const auto between = [&](Real share) { return peak + share * (end - peak); };
  return {0.5 * peak, peak, between(0.25), between(0.5), between(0.75), beyond};
}

Figures figures_of(const Response& cycles) {
  if (cycles.rows() == 0) return {};
  const std::size_t peak = peak_row(cycles);
  Real most = 0;
  for (const Real work : cycles.work) most = std::max(most, std::abs(work));
  const Real dissipated = cycles.dissipated.back();
  return {cycles.load[peak], cycles.motion[peak], std::abs(dissipated) > 1e-12 * most ? dissipated : 0};
}

}  // namespace beadwork::law
