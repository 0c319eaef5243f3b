#pragma once
// The largest stable step of a scene as it stands, and what sets it.

#include <fmt/format.h>

#include <limits>

#include "core/domain/vocabulary.hpp"
#include "core/mechanics/stability.hpp"
#include "core/plugin/kinds.hpp"

namespace beadwork {

struct StepLimit {
  Real time_step = std::numeric_limits<Real>::infinity();  ///< [s]
  std::string by = "no bond limits it";
};

/// `more(table, row, apart)` is added to the stiffness of each bond.
template <class More>
StepLimit step_limit(Workings& w, const View<const Real>& mass, const View<const Real>& inertia, const More& more) {
  const Domain& domain = w.domain();
  const auto count = static_cast<std::size_t>(domain.size());
  std::vector<Real> m(count), turning(inertia ? count : 0);
  for (Index i = 0; i < domain.size(); ++i) {
    m[static_cast<std::size_t>(i)] = mass[i];
    if (inertia) turning[static_cast<std::size_t>(i)] = inertia[i];
  }
  Mobility mobility(m, turning);
  for (const Constraint& c : w.constraints())
    if (c.grip == Grip::each)
      for (const Index row : domain.set(c.set)) mobility.hold(row, c.axis);

  ElasticNetwork network(domain.size());
  const auto position = domain.elements().column("position").view<Vec3>();
  std::vector<std::pair<const BondTable*, Index>> origin;
  for (const auto& [law, table] : w.laws())
    for (const Chunk& chunk : table->chunks())
      for (Index b = chunk.begin; b < chunk.live_end; ++b) {
        const Index i = table->first()[b], j = table->second()[b];
        network.add(i, j, law->tangent(domain, *table, b) + more(*table, b, Vec3(position[j] - position[i])));
        origin.emplace_back(table, b);
      }
  if (network.bonds() == 0) return {};
  const StableStep found = stable_step(network, mobility, 1);
  StepLimit limit{found.dt, ""};
  if (!std::isfinite(found.dt)) return {};
  limit.by = fmt::format("limited by element {}, which {}", domain.elements().column("id").view<Index>()[found.mode.element],
                         found.mode.rotates ? "turns" : "moves");
  if (found.bound.bond >= 0)
    limit.by += fmt::format(" (stiffest bond: one of '{}')", origin[static_cast<std::size_t>(found.bound.bond)].first->name());
  return limit;
}

}  // namespace beadwork
