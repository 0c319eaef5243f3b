#pragma once
// Loops over elements that do each row by itself, as many rows at once as a pack has lanes. What is done with a row
// does not depend on which rows it shares a pack with, so neither do the bits.

#include <algorithm>
#include <cstring>
#include <type_traits>
#include <utility>

#include "core/base/pack.hpp"
#include "core/base/parallel.hpp"
#include "core/base/sums.hpp"
#include "core/domain/view.hpp"

namespace beadwork {

/// The rows of elements at hand: row, row + 1, ... row + W - 1. at(column) loads their values, at.set(column, value)
/// stores them.
template <int W>
struct Rows {
  using Number = Pack<W>;
  static constexpr int count = W;
  Index row = 0;

  [[gnu::always_inline]] Pack<W> operator()(const View<const Real>& column) const {
    return [&]<std::size_t... k>(std::index_sequence<k...>) __attribute__((always_inline)) {
      return Pack<W>(typename Pack<W>::Native{column[row + static_cast<Index>(k)]...});
    }
    (std::make_index_sequence<W>());
  }
  // Four numbers are read where three are wanted: a line of elements is long enough (Table::Layout::rows).
  [[gnu::always_inline]] Vec<Pack<W>> operator()(const View<const Vec3>& column) const {
    const auto c = pack::fetch<W>([&](int lane) { return &column.at(row + lane, 0); });
    return {c[0], c[1], c[2]};
  }
  [[gnu::always_inline]] Quaternion<Pack<W>> operator()(const View<const Quat>& column) const {
    const auto c = pack::fetch<W>([&](int lane) { return &column.at(row + lane, 0); });
    return {c[0], {c[1], c[2], c[3]}};
  }
  [[gnu::always_inline]] void set(const View<Vec3>& column, const Vec<Pack<W>>& value) const {
    const auto rows = pack::rows<W>({value[0], value[1], value[2], value[2]});
    for (int k = 0; k < W; ++k) {
      Real* to = &column.at(row + k, 0);
      std::memcpy(to, &rows[static_cast<std::size_t>(k)].v, 2 * sizeof(Real));
      to[2] = rows[static_cast<std::size_t>(k)].v[2];
    }
  }
  [[gnu::always_inline]] void set(const View<Quat>& column, const Quaternion<Pack<W>>& value) const {
    const auto rows = pack::rows<W>({value.w, value.v[0], value.v[1], value.v[2]});
    for (int k = 0; k < W; ++k) rows[static_cast<std::size_t>(k)].store(&column.at(row + k, 0));
  }
};

template <>
struct Rows<1> {
  using Number = Real;
  static constexpr int count = 1;
  Index row = 0;

  [[gnu::always_inline]] Real operator()(const View<const Real>& column) const { return column[row]; }
  [[gnu::always_inline]] Vec3 operator()(const View<const Vec3>& column) const { return column[row]; }
  [[gnu::always_inline]] Quat operator()(const View<const Quat>& column) const { return column[row]; }
  [[gnu::always_inline]] void set(const View<Vec3>& column, const Vec3& value) const { column.set(row, value); }
  [[gnu::always_inline]] void set(const View<Quat>& column, const Quat& value) const { column.set(row, value); }
};

namespace rows {

inline constexpr Index block = 1024;
inline constexpr Index few = 5;  ///< blocks from which on they are shared among the threads

/// f(at) for the rows begin ... end - 1, in packs and then one by one.
template <class F>
[[gnu::always_inline]] inline void each_of(Index begin, Index end, const F& f) {
  Index row = begin;
  if constexpr (pack_width > 1)
    for (; row + pack_width <= end; row += pack_width) f(Rows<pack_width>{row});
  for (; row < end; ++row) f(Rows<1>{row});
}

/// Whether f(at), a mask, held for any row.
template <class F>
bool any_of(Index count, const F& f) {
  const Index blocks = (count + block - 1) / block;
  const auto in_block = [&](Index b) {
    bool here = false;
    each_of(b * block, std::min(count, (b + 1) * block), [&](const auto& at) { here |= any(f(at)); });
    return here;
  };
  return any_shared(blocks, in_block, few);
}

/// Sum of f(at) over all rows: row by row in each block, then the blocks in order.
template <class F>
Real sum(Index count, const F& f) {
  return sum_of_blocks((count + block - 1) / block, [&](Index b) {
    Real total = 0;
    each_of(b * block, std::min(count, (b + 1) * block), [&](const auto& at) {
      const auto term = f(at);
      if constexpr (std::is_same_v<std::decay_t<decltype(term)>, Real>)
        total += term;
      else
        for (int k = 0; k < pack_width; ++k) total += term.v[k];
    });
    return total;
  });
}

}  // namespace rows
}  // namespace beadwork
