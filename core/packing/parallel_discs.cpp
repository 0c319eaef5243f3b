#include "core/packing/parallel_discs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <sstream>

#include "core/base/random.hpp"
#include "core/packing/packing.hpp"

namespace beadwork::packing {
namespace {

constexpr int most_sweeps = 20000;  // 100 discs at an area fraction of .7 take some 2000
constexpr int stirring = 200;       // sweeps once they have room

/// Discs in square cells as wide as the distance that is asked for: what is nearer lies in one of nine.
class Cells {
 public:
  explicit Cells(const Discs& q) : low_(q.low), edge_(q.distance) {
    const Place extent = q.high - q.low;
    constexpr Real most = 1000;  // along a side
    edge_ = std::max({edge_, extent[0] / most, extent[1] / most});
    for (int a = 0; a < 2; ++a) across_[a] = static_cast<int>(extent[a] / edge_) + 1;
    members_.resize(static_cast<std::size_t>(across_[0]) * static_cast<std::size_t>(across_[1]));
  }
  void add(std::size_t disc, const Place& x) { members_[cell(x)].push_back(disc); }
  void move(std::size_t disc, const Place& from, const Place& to) {
    const std::size_t before = cell(from), now = cell(to);
    if (before == now) return;
    std::erase(members_[before], disc);
    members_[now].push_back(disc);
  }
  /// Square of the least distance from x to the centre of another disc, as far as it is below that of a cell.
  Real nearest(std::size_t disc, const Place& x, const std::vector<Place>& at) const {
    Real least = edge_ * edge_;
    const int column = along(0, x), row = along(1, x);
    for (int j = std::max(0, row - 1); j <= std::min(across_[1] - 1, row + 1); ++j)
      for (int i = std::max(0, column - 1); i <= std::min(across_[0] - 1, column + 1); ++i)
        for (const std::size_t other : members_[flat(i, j)])
          if (other != disc) least = std::min(least, (at[other] - x).squaredNorm());
    return least;
  }

 private:
  int along(int axis, const Place& x) const {
    return std::clamp(static_cast<int>((x[axis] - low_[axis]) / edge_), 0, across_[axis] - 1);
  }
  std::size_t flat(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(across_[0]) + static_cast<std::size_t>(i);
  }
  std::size_t cell(const Place& x) const { return flat(along(0, x), along(1, x)); }

  Place low_;
  Real edge_;
  int across_[2] = {1, 1};
  std::vector<std::vector<std::size_t>> members_;
};

/// More than the hexagonal packing's share of the rectangle widened by half their distance fits nowhere.
std::size_t upper_bound(const Discs& q) {
  const Place extent = q.high - q.low;
  const Real room = (extent[0] + q.distance) * (extent[1] + q.distance);
  const Real densest = std::numbers::pi / std::sqrt(Real(12));
  return static_cast<std::size_t>(densest * room / (std::numbers::pi / 4 * q.distance * q.distance));
}

/// Nothing where they find no room.
std::optional<std::vector<Place>> placed(const Discs& q) {
  Random random(q.seed, 7);
  // One number after the other: which of two arguments is evaluated first, no standard says.
  const auto draw = [&](const Place& low, const Place& high) {
    Place x;
    for (int a = 0; a < 2; ++a) x[a] = random.uniform(low[a], high[a]);
    return x;
  };
  std::vector<Place> at;
  Cells cells(q);
  for (std::size_t k = 0; k < q.count; ++k) {
    at.push_back(draw(q.low, q.high));
    cells.add(k, at.back());
  }
  const auto least_distance = [&] {
    Real least = q.distance * q.distance;
    for (std::size_t k = 0; k < q.count; ++k) least = std::min(least, cells.nearest(k, at[k], at));
    return std::sqrt(least);
  };
  Real apart = least_distance(), stride = (q.high - q.low).maxCoeff() / 4;
  for (int sweep = 0, after = 0; after < stirring; ++sweep) {
    if (sweep == most_sweeps) return std::nullopt;
    q.pause();
    std::size_t moved = 0;
    for (std::size_t k = 0; k < q.count; ++k) {
      const Place to = at[k] + stride * draw({-1, -1}, {1, 1});
      if ((to - q.low).minCoeff() < 0 || (q.high - to).minCoeff() < 0) continue;
      if (cells.nearest(k, to, at) < apart * apart) continue;
      cells.move(k, at[k], to);
      at[k] = to;
      ++moved;
    }
    // about every other move succeeds
    stride *= 2 * moved > q.count ? 1.05 : 0.95;
    stride = std::min(stride, (q.high - q.low).maxCoeff());
    apart = least_distance();
    after = apart < q.distance ? 0 : after + 1;
  }
  return at;
}

/// The most that were placed, by halving the range.
std::size_t most_placed(Discs q) {
  std::size_t fit = 1, too_many = std::min(q.count, upper_bound(q) + 1);
  while (too_many - fit > 1) {
    q.count = (fit + too_many) / 2;
    (placed(q) ? fit : too_many) = q.count;
  }
  return fit;
}

}  // namespace

std::vector<Place> place_discs(const Discs& q) {
  if (!((q.high - q.low).minCoeff() >= 0))
    throw std::invalid_argument("the box is too narrow across the fibres: they do not fit in beside its margin");
  if (q.count <= upper_bound(q))
    if (auto places = placed(q)) return *places;
  std::ostringstream out;
  out << q.count << " fibres whose centres are to be " << q.distance << " apart do not fit: " << most_placed(q)
      << " do; ask for so many, or for a smaller gap";
  throw PackingFailure(out.str());
}

}  // namespace beadwork::packing
