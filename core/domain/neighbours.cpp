#include "core/domain/neighbours.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "core/base/parallel.hpp"

namespace beadwork {
namespace {

constexpr int bits_per_axis = 21;
constexpr std::int64_t axis_mask = (std::int64_t(1) << bits_per_axis) - 1;
constexpr int max_levels = 16;

struct Rule {
  Real tolerance;
  Real gap;
  Real reach(Real a, Real b) const { return (1 + tolerance) * (a + b) + gap; }
};

struct Cloud {
  std::span<const Vec3> position;
  std::span<const Real> radius;
  Rule rule;
  Vec3 low = zero<Vec3>();
  Real extent = 0;
};

/// An element where its neighbours in space are also its neighbours in memory.
struct Member {
  Vec3 x;
  Real r;
  Index element;
};

bool near(const Rule& rule, const Member& a, const Member& b) {
  const Real reach = rule.reach(a.r, b.r);
  return (b.x - a.x).squaredNorm() <= reach * reach;
}

/// Elements of similar size in cells at least as wide as the reach of any two of them. Occupied cells only
/// are kept, in a hash table, so that one element far away costs nothing.
class Level {
 public:
  Level(const Cloud& cloud, std::vector<Index> members) : cloud_(cloud) {
    for (const Index i : members) largest_ = std::max(largest_, cloud.radius[i]);
    // So wide at least that the number of a cell is exact in floating point.
    edge_ = std::max(cloud.rule.reach(largest_, largest_), cloud.extent * 0x1p-50);
    if (!(edge_ > 0)) edge_ = 1;
    sort_into_cells(members);
    fill_table();
  }

  Real largest() const { return largest_; }
  std::size_t cells() const { return key_.size(); }
  std::span<const Member> cell(std::size_t c) const {
    return std::span(member_).subspan(start_[c], start_[c + 1] - start_[c]);
  }

  /// Calls visit(members) for each occupied cell beside a cell of this level, on one side of it: so two cells meet
  /// once.
  template <class Visit>
  void visit_cells_after(std::size_t c, const Visit& visit) const {
    const auto axis = [&](int a) { return std::int64_t(key_[c] >> a * bits_per_axis) & axis_mask; };
    for (std::int64_t dz = 0; dz <= 1; ++dz)
      for (std::int64_t dy = dz == 0 ? 0 : -1; dy <= 1; ++dy)
        for (std::int64_t dx = dz == 0 && dy == 0 ? 1 : -1; dx <= 1; ++dx) {
          const std::size_t other = find(key_of(axis(0) + dx, axis(1) + dy, axis(2) + dz));
          if (other != none) visit(cell(other));
        }
  }

  /// Calls visit(members) for each occupied cell of the 27 around x.
  template <class Visit>
  void visit_cells_around(const Vec3& x, const Visit& visit) const {
    const auto c = cell_of(x);
    for (std::int64_t dz = -1; dz <= 1; ++dz)
      for (std::int64_t dy = -1; dy <= 1; ++dy)
        for (std::int64_t dx = -1; dx <= 1; ++dx) {
          const std::size_t other = find(key_of(c[0] + dx, c[1] + dy, c[2] + dz));
          if (other != none) visit(cell(other));
        }
  }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  struct Entry {
    std::uint64_t key;
    Index element;
  };

  std::array<std::int64_t, 3> cell_of(const Vec3& x) const {
    std::array<std::int64_t, 3> c;
    for (int a = 0; a < 3; ++a) c[a] = static_cast<std::int64_t>(std::floor((x[a] - cloud_.low[a]) / edge_));
    return c;
  }
  /// Cells a multiple of 2^21 apart share a key: more candidates whose distance is looked at, nothing worse.
  static std::uint64_t key_of(std::int64_t x, std::int64_t y, std::int64_t z) {
    return std::uint64_t(x & axis_mask) | std::uint64_t(y & axis_mask) << bits_per_axis |
           std::uint64_t(z & axis_mask) << 2 * bits_per_axis;
  }

  void sort_into_cells(const std::vector<Index>& members) {
    std::vector<Entry> entries(members.size());
    member_.reserve(members.size());
    for (std::size_t k = 0; k < members.size(); ++k) {
      const auto c = cell_of(cloud_.position[members[k]]);
      entries[k] = {key_of(c[0], c[1], c[2]), members[k]};
    }
    std::sort(entries.begin(), entries.end(),
              [](const Entry& a, const Entry& b) { return a.key != b.key ? a.key < b.key : a.element < b.element; });
    for (std::size_t k = 0; k < entries.size(); ++k) {
      if (k == 0 || entries[k].key != entries[k - 1].key) {
        key_.push_back(entries[k].key);
        start_.push_back(k);
      }
      const Index i = entries[k].element;
      member_.push_back({cloud_.position[std::size_t(i)], cloud_.radius[std::size_t(i)], i});
    }
    start_.push_back(entries.size());
  }

  void fill_table() {
    table_.assign(std::bit_ceil(2 * key_.size() + 2), none);
    for (std::size_t cell = 0; cell < key_.size(); ++cell) {
      std::size_t slot = slot_of(key_[cell]);
      while (table_[slot] != none) slot = (slot + 1) & (table_.size() - 1);
      table_[slot] = cell;
    }
  }
  std::size_t slot_of(std::uint64_t key) const {
    key *= 0x9E3779B97F4A7C15ull;
    return (key ^ key >> 32) & (table_.size() - 1);
  }
  std::size_t find(std::uint64_t key) const {
    std::size_t slot = slot_of(key);
    while (table_[slot] != none && key_[table_[slot]] != key) slot = (slot + 1) & (table_.size() - 1);
    return table_[slot];
  }

  const Cloud& cloud_;
  Real largest_ = 0;
  Real edge_ = 1;
  std::vector<std::uint64_t> key_;
  std::vector<std::size_t> start_;
  std::vector<Member> member_;
  std::vector<std::size_t> table_;
};

void check(std::span<const Vec3> position, std::span<const Real> radius, const Rule& rule) {
  if (position.size() != radius.size())
    throw std::invalid_argument("there are " + std::to_string(position.size()) + " positions but " +
                                std::to_string(radius.size()) + " radii");
  if (!(std::isfinite(rule.tolerance) && rule.tolerance >= 0 && std::isfinite(rule.gap) && rule.gap >= 0))
    throw std::invalid_argument("the gap tolerance must be finite and not negative");
  const auto refuse = [](const char* what, std::size_t i, const char* why) {
    throw std::invalid_argument(std::string(what) + " of element " + std::to_string(i) + why);
  };
  for (std::size_t i = 0; i < position.size(); ++i) {
    if (!position[i].allFinite()) refuse("the position", i, " is not finite");
    if (!(std::isfinite(radius[i]) && radius[i] >= 0)) refuse("the radius", i, " is negative or not finite");
  }
}

Cloud cloud_of(std::span<const Vec3> position, std::span<const Real> radius, const Rule& rule) {
  Cloud cloud{position, radius, rule};
  if (position.empty()) return cloud;
  Vec3 high = position[0];
  cloud.low = position[0];
  for (const Vec3& x : position) {
    cloud.low = cloud.low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  cloud.extent = (high - cloud.low).maxCoeff();
  if (!std::isfinite(cloud.extent))
    throw std::invalid_argument("the elements are too far apart for numbers of this size");
  return cloud;
}

/// Levels by halves of the largest radius, from the largest elements to the smallest.
std::vector<Level> levels_of(const Cloud& cloud, std::size_t begin, std::size_t end) {
  Real largest = 0;
  for (std::size_t i = begin; i < end; ++i) largest = std::max(largest, cloud.radius[i]);
  std::vector<std::vector<Index>> members(max_levels);
  for (std::size_t i = begin; i < end; ++i) {
    const Real ratio = cloud.radius[i] > 0 ? largest / cloud.radius[i] : Real(1 << max_levels);
    const int level = std::min(ratio < Real(1 << max_levels) ? std::ilogb(ratio) : max_levels, max_levels - 1);
    members[std::size_t(level)].push_back(static_cast<Index>(i));
  }
  std::vector<Level> levels;
  for (auto& m : members)
    if (!m.empty()) levels.emplace_back(cloud, std::move(m));
  return levels;
}

/// Looks at the cells of levels, block by block; the pairs of each block stand in a list of their own.
struct Search {
  Rule rule;
  const Pause& pause;
  std::vector<std::vector<Pair>> found = {};

  /// Calls look(cell, pairs) for each cell of a level.
  template <class Look>
  void each_cell(const Level& level, const Look& look) {
    constexpr std::size_t block = 256, stretch = 256;  // cells, blocks
    const std::size_t blocks = (level.cells() + block - 1) / block;
    const std::size_t base = found.size();
    found.resize(base + blocks);
    for (std::size_t from = 0; from < blocks; from += stretch) {
      pause();
      const std::size_t to = std::min(blocks, from + stretch);
      each_shared(
          to - from,
          [&](std::size_t k) {
            const std::size_t b = from + k, end = std::min(level.cells(), (b + 1) * block);
            for (std::size_t cell = b * block; cell < end; ++cell) look(cell, found[base + b]);
          },
          20);
    }
  }
};

void add_if_near(const Rule& rule, const Member& a, const Member& b, std::vector<Pair>& pairs) {
  if (near(rule, a, b)) pairs.push_back({std::min(a.element, b.element), std::max(a.element, b.element)});
}

/// Whatever shares a cell is near, but for its corners: where that alone makes too many pairs, nobody should begin to
/// look.
void refuse_crowds(const std::vector<Level>& levels) {
  Real pairs = 0;
  for (const Level& level : levels)
    for (std::size_t cell = 0; cell < level.cells(); ++cell) {
      const Real members = static_cast<Real>(level.cell(cell).size());
      pairs += members * (members - 1) / 2;
    }
  if (pairs > most_pairs)
    throw std::invalid_argument(
        "the elements lie so close together, or the gap between those that are looked for is so large, that about " +
        std::to_string(static_cast<std::int64_t>(std::min(pairs, 1e18))) + " pairs are near: more than can be held");
}

/// Pairs of the members of a level with each other.
void search_in(Search& search, const Level& level) {
  const Rule& rule = search.rule;
  search.each_cell(level, [&](std::size_t cell, std::vector<Pair>& pairs) {
    const auto own = level.cell(cell);
    for (std::size_t k = 0; k < own.size(); ++k)
      for (std::size_t l = k + 1; l < own.size(); ++l) add_if_near(rule, own[k], own[l], pairs);
    level.visit_cells_after(cell, [&](std::span<const Member> others) {
      for (const Member& a : own)
        for (const Member& b : others) add_if_near(rule, a, b, pairs);
    });
  });
}

/// Pairs of the members of a level with those of another, whose elements are larger.
void search_among(Search& search, const Level& level, const Level& larger) {
  const Rule& rule = search.rule;
  search.each_cell(level, [&](std::size_t cell, std::vector<Pair>& pairs) {
    for (const Member& a : level.cell(cell))
      larger.visit_cells_around(a.x, [&](std::span<const Member> others) {
        for (const Member& b : others) add_if_near(rule, a, b, pairs);
      });
  });
}

std::vector<Pair> sorted(const std::vector<std::vector<Pair>>& found, std::size_t elements) {
  std::vector<std::size_t> first(elements + 1, 0);
  for (const auto& part : found)
    for (const Pair& p : part) ++first[std::size_t(p.i) + 1];
  for (std::size_t i = 0; i < elements; ++i) first[i + 1] += first[i];
  std::vector<Pair> pairs(first[elements]);
  std::vector<std::size_t> next(first.begin(), first.end() - 1);
  for (const auto& part : found)
    for (const Pair& p : part) pairs[next[p.i]++] = p;
  const auto sort_those_of = [&](std::size_t i) {
    std::sort(pairs.begin() + std::ptrdiff_t(first[i]), pairs.begin() + std::ptrdiff_t(first[i + 1]),
              [](const Pair& a, const Pair& b) { return a.j < b.j; });
  };
  each_shared(elements, sort_those_of, 20001);
  return pairs;
}

}  // namespace

std::vector<Pair> find_pairs(std::span<const Vec3> position, std::span<const Real> radius, Real tolerance, Real gap,
                             const Pause& pause) {
  return find_pairs_around(position, radius, position.size(), tolerance, gap, pause);
}

std::vector<Pair> find_pairs_around(std::span<const Vec3> position, std::span<const Real> radius, std::size_t moving,
                                    Real tolerance, Real gap, const Pause& pause) {
  const Rule rule{tolerance, gap};
  check(position, radius, rule);
  const Cloud cloud = cloud_of(position, radius, rule);
  moving = std::min(moving, position.size());
  pause();
  const auto own = levels_of(cloud, 0, moving);
  const auto fixed = levels_of(cloud, moving, position.size());
  refuse_crowds(own);
  Search search{rule, pause};
  for (std::size_t a = 0; a < own.size(); ++a) {
    search_in(search, own[a]);
    for (std::size_t b = 0; b < a; ++b) search_among(search, own[a], own[b]);
    for (const Level& f : fixed)
      if (own[a].largest() <= f.largest())
        search_among(search, own[a], f);
      else
        search_among(search, f, own[a]);
  }
  return sorted(search.found, position.size());
}

NeighbourList neighbours_of(std::span<const Pair> pairs, std::size_t elements) {
  NeighbourList list;
  list.first.assign(elements + 1, 0);
  for (const Pair& p : pairs) {
    ++list.first[std::size_t(p.i) + 1];
    ++list.first[std::size_t(p.j) + 1];
  }
  for (std::size_t i = 0; i < elements; ++i) list.first[i + 1] += list.first[i];
  list.other.resize(list.first[elements]);
  std::vector<std::size_t> next(list.first.begin(), list.first.end() - 1);
  for (const Pair& p : pairs) list.other[next[p.j]++] = p.i;  // the smaller ones first: pairs are sorted by i
  for (const Pair& p : pairs) list.other[next[p.i]++] = p.j;
  return list;
}

}  // namespace beadwork
