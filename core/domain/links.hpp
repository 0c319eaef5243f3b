#pragma once
// From an element to the bonds that hold it.

#include <span>
#include <vector>

#include "core/domain/bond_table.hpp"

namespace beadwork {

/// Of one family, as its rows stand: to be made anew once bonds have been swept.
class Links {
 public:
  Links(const BondTable& table, Index elements);

  /// Rows of its live bonds, ascending.
  std::span<const Index> of(Index element) const {
    const auto i = static_cast<std::size_t>(element);
    return {rows_.data() + begin_[i], rows_.data() + begin_[i + 1]};
  }

 private:
  std::vector<std::size_t> begin_;  // by element, and one more
  std::vector<Index> rows_;
};

}  // namespace beadwork
