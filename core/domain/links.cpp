#include "core/domain/links.hpp"

#include <numeric>

namespace beadwork {

Links::Links(const BondTable& table, Index elements) : begin_(static_cast<std::size_t>(elements) + 1, 0) {
  const auto each_end = [&](const auto& visit) {
    for (const Chunk& chunk : table.chunks())
      for (Index row = chunk.begin; row < chunk.live_end; ++row)
        for (const Index end : {table.first()[row], table.second()[row]}) visit(static_cast<std::size_t>(end), row);
  };
  each_end([&](std::size_t element, Index) { ++begin_[element + 1]; });
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  rows_.resize(begin_.back());
  std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
  each_end([&](std::size_t element, Index row) { rows_[next[element]++] = row; });
}

}  // namespace beadwork
