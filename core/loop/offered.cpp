#include "core/loop/offered.hpp"

#include <algorithm>
#include <cstring>

namespace beadwork {

Offered::Offered(const Scene& scene) : scene_(scene) {
  for (const auto& plugin : scene.plugins)
    for (const FieldUse* use : plugin->uses()) {
      if (use->verb() != Verb::writes || use->field().on != On::bonds) continue;
      for (const std::string& family : plugin->families()) {
        BondTable* table = scene.domain->find_family(family);
        if (!table) continue;
        Column* column = table->rows().find(use->field().name);
        auto& columns = columns_[table];
        if (column && !column->kept() && std::find(columns.begin(), columns.end(), column) == columns.end())
          columns.push_back(column);
      }
    }
}

void Offered::begin_stage() {
  begin_step();
  held_.clear();
  for (const auto& [table, columns] : columns_)
    for (Column* column : columns) clear(*column, 0, table->size());
}

void Offered::begin_step() {
  told_ = false;
  judged_.clear();
  with_utilisation_.clear();
}

Verdict Offered::judge(Failure& failure, Domain& domain) {
  std::vector<std::pair<Column*, std::vector<Real>>> of_others;  // what others have told of the same bonds
  for (Table* table : failure.tables(domain, failure.utilisation.field().on)) {
    Column& column = table->column(failure.utilisation.field().name);
    const bool first = with_utilisation_.insert(&column).second;
    if (first || !is_read()) continue;
    const auto told = column.view<Real>();
    auto& aside = of_others.emplace_back(&column, std::vector<Real>()).second;
    for (Index row = 0; row < table->size(); ++row) aside.push_back(told[row]);
  }
  judged_.insert(&failure);
  failure.judge(domain);
  const auto held = failure.judges_elements() ? std::span(held_for(failure, domain)) : std::span<const char>();
  Verdict verdict = read_verdict(failure, domain, held);
  for (const auto& [column, aside] : of_others) {
    const auto told = column->view<Real>();
    for (std::size_t row = 0; row < aside.size(); ++row)
      told[static_cast<Index>(row)] = std::max(told[static_cast<Index>(row)], aside[row]);
  }
  return verdict;
}

void Offered::note_broken() {
  told_ &= scene_.summing.empty();
  held_.clear();
}

// Found anew when a stage has begun and when something has broken.
const std::vector<char>& Offered::held_for(const Failure& failure, const Domain& domain) {
  std::vector<char>& held = held_[&failure];
  if (!held.empty()) return held;
  held.assign(static_cast<std::size_t>(domain.size()), 0);
  for (const std::string& family : failure.families()) {
    const BondTable& table = *domain.find_family(family);
    for (const Chunk& chunk : table.chunks())
      for (Index row = chunk.begin; row < chunk.live_end; ++row)
        for (const Index end : {table.first()[row], table.second()[row]}) held[static_cast<std::size_t>(end)] = 1;
  }
  return held;
}

void Offered::clear(const BondTable& table, Index row) const {
  const auto found = columns_.find(&table);
  if (found == columns_.end()) return;
  for (Column* column : found->second) clear(*column, row, row + 1);
}

// Columns of bonds lie plane by plane.
void Offered::clear(Column& column, Index begin, Index end) const {
  const Type type = column.field().type;
  for (int c = 0; c < components(type); ++c)
    std::memset(column.base() + static_cast<std::size_t>(c) * column.plane() +
                    static_cast<std::size_t>(begin) * column.stride(),
                0, static_cast<std::size_t>(end - begin) * component_bytes(type));
}

LoadsAside::LoadsAside(Domain& domain) {
  for (const char* name : {"force", "torque"})
    if (Column* column = domain.elements().find(name)) {
      Kept kept{column->view<Vec3>(), {}};
      for (Index row = 0; row < domain.size(); ++row) kept.sums.push_back(kept.view[row]);
      kept_.push_back(std::move(kept));
    }
}

LoadsAside::~LoadsAside() {
  for (const Kept& kept : kept_)
    for (std::size_t row = 0; row < kept.sums.size(); ++row) kept.view.set(static_cast<Index>(row), kept.sums[row]);
}

}  // namespace beadwork
