#include "core/domain/domain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "core/base/parallel.hpp"
#include "core/domain/vocabulary.hpp"

namespace beadwork {

Domain::Domain() {
  scene_.resize(1);
  elements_.add(field::element_id).keep();
  elements_.add(field::position).keep();
  elements_.add(field::radius).keep();
}

Table& Domain::list(const std::string& name) { return lists_.try_emplace(name, Table::Layout::planes).first->second; }

Index Domain::add_elements(Index count) {
  const Index first = size();
  elements_.resize(first + count);
  const auto id = elements_.column("id").view<Index>();
  for (Index row = first; row < size(); ++row) id[row] = row;
  if (Column* orientation = elements_.find("orientation"))
    for (Index row = first; row < size(); ++row) orientation->view<Quat>().set(row, identity());
  return first;
}

void Domain::reorder(const std::vector<Index>& order) {
  elements_.permute(order);
  std::vector<Index> row_of(order.size());
  for (std::size_t row = 0; row < order.size(); ++row)
    row_of[static_cast<std::size_t>(order[row])] = static_cast<Index>(row);
  for (auto& [name, set] : sets_) {
    for (Index& row : set) row = row_of[static_cast<std::size_t>(row)];
    std::sort(set.begin(), set.end());
  }
  for (auto& [name, pairs] : pairs_) rename_rows(pairs, row_of);
  walls_.reorder(row_of);
}

Pose Domain::pose(Index row) const {
  const Column* turned = elements_.find("orientation");
  return {elements_.column("position").view<Vec3>()[row], turned ? turned->view<Quat>()[row] : identity()};
}

const Set& Domain::set(const std::string& name) const {
  const auto found = sets_.find(name);
  if (found == sets_.end()) throw std::logic_error(fmt::format("no set '{}' in this scene", name));
  return found->second;
}

BondTable& Domain::add_family(const std::string& name) {
  families_.push_back(std::make_unique<BondTable>(name));
  shown_.push_back(families_.back().get());
  return *families_.back();
}

BondTable& Domain::add_contacts(const std::string& name) {
  BondTable& table = add_family(name);
  table.let_pairs_come_and_go();
  return table;
}

const BondTable* Domain::find_family(const std::string& name) const {
  for (const auto& family : families_)
    if (family->name() == name) return family.get();
  return nullptr;
}

BondTable* Domain::find_family(const std::string& name) {
  return const_cast<BondTable*>(std::as_const(*this).find_family(name));
}

Index Domain::bonds() const {
  Index sum = 0;
  for (const auto& family : families_)
    if (!family->is_of_contacts()) sum += family->size();
  return sum;
}

void Domain::cut_families() {
  Index halo = size();
  std::vector<std::pair<Index, Index>> entries;
  for (const auto& family : families_) {
    halo = family->cut(size(), halo);
    entries.insert(entries.end(), family->halo().begin(), family->halo().end());
  }
  std::sort(entries.begin(), entries.end());
  shares_.clear();
  share_rows_.clear();
  for (const auto& [element, row] : entries) {
    const auto here = static_cast<Index>(share_rows_.size());
    if (shares_.empty() || shares_.back().element != element) shares_.push_back({element, here, here});
    share_rows_.push_back(row);
    shares_.back().end = here + 1;
  }
  elements_.reserve_beyond("load", halo - size());
  for (const Column* sum : sums()) elements_.reserve_beyond(sum->field().line, halo - size());
}

void Domain::gather() {
  if (shares_.empty()) return;
  const auto force = elements_.column("force").view<Vec3>();
  Column* torques = elements_.find("torque");
  const auto torque = torques ? torques->view<Vec3>() : View<Vec3>{};
  const auto count = static_cast<Index>(shares_.size());
  each_shared(
      count,
      [&](Index s) {
        const Share& share = shares_[static_cast<std::size_t>(s)];
        const auto later =
            static_cast<std::size_t>(share.begin) + 32;  // halo rows come from all chunks around: fetched in time
        if (later < share_rows_.size()) __builtin_prefetch(&force.at(share_rows_[later], 0));
        Vec3 sum = force[share.element];
        for (Index k = share.begin; k < share.end; ++k) sum += force[share_rows_[static_cast<std::size_t>(k)]];
        force.set(share.element, sum);
        if (!torque) return;
        sum = torque[share.element];
        for (Index k = share.begin; k < share.end; ++k) sum += torque[share_rows_[static_cast<std::size_t>(k)]];
        torque.set(share.element, sum);
      },
      256);
}

std::vector<Column*> Domain::sums() {
  std::vector<Column*> all = elements_.columns();
  std::erase_if(all, [](const Column* column) { return !column->summed(); });
  return all;
}

void Domain::clear_sums() {
  const std::size_t rows = static_cast<std::size_t>(size()) + share_rows_.size();
  for (Column* sum : sums()) std::memset(sum->base(), 0, rows * sum->stride());
}

void Domain::gather_sums() {
  for (Column* column : sums()) {
    const auto number = [&](Index row, int c) -> Real& {
      return reinterpret_cast<Real*>(column->base() + static_cast<std::size_t>(row) * column->stride())[c];
    };
    each_shared(
        static_cast<Index>(shares_.size()),
        [&](Index s) {
          const Share& share = shares_[static_cast<std::size_t>(s)];
          for (Index k = share.begin; k < share.end; ++k)
            for (int c = 0; c < components(column->field().type); ++c)
              number(share.element, c) += number(share_rows_[static_cast<std::size_t>(k)], c);
        },
        256);
  }
}

void Domain::clear_loads() {
  for (const char* name : {"force", "torque"})
    if (Column* load = elements_.find(name)) {
      const auto sum = load->view<Vec3>();
      for (Index row = 0; row < size(); ++row) sum.set(row, zero<Vec3>());
    }
}

void Domain::clear_halo() {
  for (const char* name : {"force", "torque"})
    if (Column* load = elements_.find(name))
      for (const Index row : share_rows_) load->view<Vec3>().set(row, zero<Vec3>());
}

}  // namespace beadwork
