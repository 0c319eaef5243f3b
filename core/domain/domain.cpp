#include "core/domain/domain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "core/base/parallel.hpp"
#include "core/domain/vocabulary.hpp"

namespace beadwork {

Domain::Domain() {
  scene_.resize(1);
  elements_.add(field::element_id).keep();
  elements_.add(field::position).keep();
  elements_.add(field::radius).keep();
}

Table& Domain::list(const std::string& name) {
  std::unique_ptr<Table>& there = lists_[name];
  if (!there) there = std::make_unique<Table>(Table::Layout::planes);
  return *there;
}

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
}

const Set& Domain::set(const std::string& name) const {
  const auto found = sets_.find(name);
  if (found == sets_.end()) throw std::logic_error(fmt::format("no set '{}' in this scene", name));
  return found->second;
}

BondTable& Domain::add_family(const std::string& name) {
  families_.push_back(std::make_unique<BondTable>(name));
  return *families_.back();
}

BondTable* Domain::find_family(const std::string& name) const {
  for (const auto& family : families_)
    if (family->name() == name) return family.get();
  return nullptr;
}

Index Domain::bonds() const {
  Index sum = 0;
  for (const auto& family : families_) sum += family->size();
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
}

void Domain::gather() {
  if (shares_.empty()) return;
  const auto force = elements_.column("force").view<Vec3>();
  const Column* torques = elements_.find("torque");
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

void Domain::clear_loads() {
  for (const char* name : {"force", "torque"})
    if (const Column* load = elements_.find(name)) {
      const auto sum = load->view<Vec3>();
      for (Index row = 0; row < size(); ++row) sum.set(row, zero<Vec3>());
    }
}

void Domain::clear_halo() {
  for (const char* name : {"force", "torque"})
    if (const Column* load = elements_.find(name))
      for (const Index row : share_rows_) load->view<Vec3>().set(row, zero<Vec3>());
}

}  // namespace beadwork
