// A frame of a run that ran away, or a damaged one: one bad number must not cost the picture of the others.

#include <algorithm>
#include <cmath>
#include <limits>

#include "workbench/report/specimen.hpp"
#include "workbench/report/table.hpp"

namespace beadwork::report {

namespace {

// Beyond any specimen, and far from where the single precision of a picture overflows [m].
constexpr Real farthest = 1e12, smallest = 1e-20;
// Splinters fly some lengths of the specimen; the picture of what lies a thousand away would show nothing else.
constexpr Real far_outside = 1000;

bool is_drawable(const Vec3& place) { return place.cwiseAbs().maxCoeff() <= farthest; }  // false for what is no number
bool has_place(const record::Frame& frame, std::size_t i) {
  const Vec3& p = frame.position[i];
  return std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z()) && is_drawable(p) &&
         frame.radius[i] >= smallest && frame.radius[i] <= farthest;
}

/// The value that a share of them does not exceed.
Real quantile(std::vector<Real> values, Real share) {
  const auto rank = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<Real>(values.size() - 1));
  std::nth_element(values.begin(), rank, values.end());
  return *rank;
}

}  // namespace

std::size_t leave_out_odd(record::Frame& frame) {
  const auto finite = [](const Vec3& u) {
    return std::isfinite(u.x()) && std::isfinite(u.y()) && std::isfinite(u.z());
  };
  if (!std::all_of(frame.displacement.begin(), frame.displacement.end(),
                   [&](const Vec3& u) { return finite(u) && is_drawable(u); }))
    frame.displacement.clear();  // it follows from the places
  const auto walls =
      frame.walls.empty() ? 0 : std::count(frame.radius.begin(), frame.radius.end(), 0);  // drawn by lines
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < frame.position.size(); ++i)
    if (has_place(frame, i)) rows.push_back(i);
  std::vector<bool> drawn(frame.position.size(), false);
  if (!rows.empty()) {
    const auto each = [&](const auto& value) {
      std::vector<Real> values;
      for (const std::size_t row : rows) values.push_back(value(row));
      return values;
    };
    Vec3 middle;
    for (int axis = 0; axis < 3; ++axis)
      middle[axis] = quantile(each([&](std::size_t row) { return frame.position[row][axis]; }), 0.5);
    const auto distance = [&](std::size_t row) { return (frame.position[row] - middle).cwiseAbs().maxCoeff(); };
    const auto size = [&](std::size_t row) { return frame.radius[row]; };
    const Real room = far_outside * (quantile(each(distance), 0.9) + quantile(each(size), 0.5));
    for (const std::size_t row : rows) drawn[row] = distance(row) + size(row) <= room;
  }
  for (std::size_t i = 0; i < drawn.size(); ++i)
    if (!drawn[i]) {
      frame.position[i] = Vec3::Constant(std::numeric_limits<Real>::quiet_NaN());
      frame.radius[i] = 0;
    }
  const auto leave_gaps = [](std::vector<record::FieldValues>& fields) {
    for (record::FieldValues& field : fields)
      for (Real& value : field.values)
        if (!(std::abs(value) <= largest_drawn)) value = std::numeric_limits<Real>::quiet_NaN();
  };
  leave_gaps(frame.fields);
  for (record::Bonds& bonds : frame.bonds) leave_gaps(bonds.fields);
  return static_cast<std::size_t>(std::count(drawn.begin(), drawn.end(), false) - walls);
}

}  // namespace beadwork::report
