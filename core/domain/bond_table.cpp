#include "core/domain/bond_table.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include "core/domain/vocabulary.hpp"

namespace beadwork {

Index block_length(Index elements) { return std::clamp<Index>(elements / 32, 64, 1024); }

Index block_count(Index elements) {
  const Index length = block_length(elements);
  return (elements + length - 1) / length;
}

BondTable::BondTable(std::string name) : name_(std::move(name)) {
  const auto index = [&](const char* field, const char* doc) {
    rows_.add({field, On::bonds, Type::index, "1", doc, ""}).keep();
  };
  index("id", "Stable number of the bond");
  index("first", "Row of the first element");
  index("second", "Row of the second element");
  rows_.add({"target", On::bonds, Type::index, "1", "Row that takes the force on the second element", ""});
  rows_.add({"state", On::bonds, Type::state, "1", "0 intact, 1 softening, 2 broken", ""}).keep();
  rebind();
}

void BondTable::rebind() {
  id_ = rows_.column("id").view<Index>();
  first_ = rows_.column("first").view<Index>();
  second_ = rows_.column("second").view<Index>();
  target_ = rows_.column("target").view<Index>();
  state_ = rows_.column("state").view<State>();
  if (Column* facet = rows_.find(field::facet.name)) facet_ = facet->view<Real>();
}

Index BondTable::live() const {
  Index sum = 0;
  for (const Chunk& chunk : chunks_) sum += chunk.live_end - chunk.begin;
  return sum;
}

void BondTable::create(std::vector<std::pair<Index, Index>> pairs, Index first_id) {
  for (auto& [a, b] : pairs)
    if (a > b) std::swap(a, b);
  std::sort(pairs.begin(), pairs.end());
  rows_.resize(static_cast<Index>(pairs.size()));
  rebind();
  for (Index row = 0; row < size(); ++row) {
    id_[row] = first_id + row;
    first_[row] = pairs[static_cast<std::size_t>(row)].first;
    second_[row] = pairs[static_cast<std::size_t>(row)].second;
    state_[row] = State::intact;
  }
}

void BondTable::let_pairs_be_with_walls() {
  rows_.add(field::facet).keep();
  rebind();
}

std::vector<Index> BondTable::renew(const std::vector<Near>& pairs) {
  std::vector<Index> fresh, origin(pairs.size(), -1);
  Index old = 0;  // both lists are sorted
  for (std::size_t row = 0; row < pairs.size(); ++row) {
    while (old < size() && near(old) < pairs[row]) ++old;
    if (old < size() && near(old) == pairs[row])
      origin[row] = old;
    else
      fresh.push_back(static_cast<Index>(row));
  }
  rows_.permute(origin);
  rebind();
  for (Index row = 0; row < size(); ++row) id_[row] = row;
  for (const Index row : fresh) {
    const Near& pair = pairs[static_cast<std::size_t>(row)];
    first_[row] = pair.first;
    second_[row] = pair.second;
    if (facet_) facet_[row] = pair.facet;
  }
  return fresh;
}

Index BondTable::cut(Index elements, Index halo_begin) {
  const Index length = block_length(elements);
  chunks_.assign(static_cast<std::size_t>(block_count(elements)), Chunk{});
  halo_.clear();
  Index row = 0;
  Index halo = halo_begin;
  for (std::size_t c = 0; c < chunks_.size(); ++c) {
    const Index block_end = static_cast<Index>(c + 1) * length;
    Chunk& chunk = chunks_[c];
    chunk.begin = row;
    while (row < size() && first_[row] < block_end) ++row;
    chunk.end = row;
    // Broken rows that are not swept yet may stand among the live ones, when a checkpoint was written between the two.
    chunk.live_end = chunk.end;
    while (!broken_act_ && chunk.live_end > chunk.begin && state_[chunk.live_end - 1] >= State::broken)
      --chunk.live_end;
    chunk.halo_begin = halo;
    std::map<Index, Index> outside;  // element -> its halo row, in the order of elements
    for (Index b = chunk.begin; b < chunk.end; ++b)
      if (second_[b] >= block_end) outside[second_[b]] = 0;
    for (auto& [element, target] : outside) {
      target = halo++;
      halo_.push_back({element, target});
    }
    chunk.halo_end = halo;
    for (Index b = chunk.begin; b < chunk.end; ++b)
      target_[b] = second_[b] < block_end ? second_[b] : outside[second_[b]];
  }
  return halo;
}

void BondTable::sweep() {
  if (broken_act_) return;
  std::vector<Index> order;
  for (Chunk& chunk : chunks_) {
    order.resize(static_cast<std::size_t>(chunk.live_end - chunk.begin));
    std::iota(order.begin(), order.end(), chunk.begin);
    const auto middle =
        std::stable_partition(order.begin(), order.end(), [&](Index b) { return state_[b] < State::broken; });
    if (middle == order.end()) continue;
    rows_.permute_range(chunk.begin, order);
    chunk.live_end = chunk.begin + static_cast<Index>(middle - order.begin());
  }
}

}  // namespace beadwork
