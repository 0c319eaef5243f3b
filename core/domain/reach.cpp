#include "core/domain/reach.hpp"

#include <algorithm>

#include "core/base/parallel.hpp"

namespace beadwork {

namespace {

bool lies_between(const Vec3& a, const Vec3& b, const Vec3& x, Real radius) {
  const Vec3 line = b - a, arm = x - a;
  const Real length2 = line.squaredNorm(), along = arm.dot(line);
  if (!(along > 0 && along < length2)) return false;
  const Real aside2 = arm.squaredNorm() - along * along / length2;
  return aside2 < radius * radius / 4;
}

}  // namespace

std::vector<Index> elements_between(std::span<const Vec3> position, std::span<const Real> radius,
                                    std::span<const Pair> pairs, const Pause& pause) {
  const NeighbourList list = neighbours_of(pairs, position.size());
  std::vector<Index> between(pairs.size(), -1);
  constexpr std::size_t stretch = 4096;
  for (std::size_t begin = 0; begin < pairs.size(); begin += stretch) {
    pause();
    const std::size_t end = std::min(pairs.size(), begin + stretch);
    each_shared(
        end - begin,
        [&](std::size_t step) {
          const std::size_t p = begin + step;
          const auto i = static_cast<std::size_t>(pairs[p].i), j = static_cast<std::size_t>(pairs[p].j);
          const auto others = list.of(j);
          for (const Index k : list.of(i)) {
            const auto at = static_cast<std::size_t>(k);
            if (!lies_between(position[i], position[j], position[at], radius[at]) ||
                !std::binary_search(others.begin(), others.end(), k))
              continue;
            between[p] = k;
            break;
          }
        },
        pairs.size() > 5 * stretch ? 2 : stretch + 1);
  }
  return between;
}

}  // namespace beadwork
