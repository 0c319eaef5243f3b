#pragma once
// Rows that are joined one pair at a time (disjoint sets, Tarjan 1975).

#include <algorithm>
#include <numeric>
#include <vector>

#include "core/base/types.hpp"

namespace beadwork {

class Joined {
 public:
  explicit Joined(Index rows) : lower_(static_cast<std::size_t>(rows)) { std::iota(lower_.begin(), lower_.end(), 0); }

  void join(Index one, Index other) {
    const auto [first, second] = std::minmax({lowest(one), lowest(other)});
    lower_[static_cast<std::size_t>(second)] = first;
  }
  /// Of the rows that are joined to this one.
  Index lowest(Index row) {
    while (lower_[static_cast<std::size_t>(row)] != row) {
      Index& next = lower_[static_cast<std::size_t>(row)];
      row = next = lower_[static_cast<std::size_t>(next)];
    }
    return row;
  }

 private:
  std::vector<Index> lower_;  ///< a row that is joined to this one and not above it, or itself
};

}  // namespace beadwork
