#pragma once
// The largest stable step of a scene as it stands, and what sets it.

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>

#include "core/base/parallel.hpp"
#include "core/domain/vocabulary.hpp"
#include "core/mechanics/stability.hpp"
#include "core/plugin/blame.hpp"
#include "core/plugin/kinds.hpp"

namespace beadwork {

struct StepLimit {
  Real time_step = std::numeric_limits<Real>::infinity();  ///< [s]
  std::string by = "no bond limits it";
};

/// Refuses bonds whose stiffness no time step can be found for, as that is done in single precision: nearly always they
/// are as good as no length.
template <class Parts>
void refuse_too_stiff(const Domain& domain, const ElasticNetwork& network, const Parts& parts) {
  const auto id = domain.elements().column("id").view<Index>();
  const auto position = domain.elements().column("position").view<Vec3>();
  for (const auto& [law, table, chunk, begin] : parts)
    for (Index b = chunk.begin; b < chunk.live_end; ++b) {
      if (network.stiffness(begin + b - chunk.begin).allFinite()) continue;
      const Index i = table->first()[b], j = table->second()[b];
      refuse(law->at(), fmt::format("the bond of elements {} and {}, {:.3g} m apart, is stiffer than any number that a "
                                    "time step can be found for; move them apart or leave it out",
                                    id[i], id[j], Vec3(position[j] - position[i]).norm()));
    }
}

/// `more(law, table, row, apart)` is added to the stiffness of each bond.
template <class More>
StepLimit elastic_limit(Workings& w, const View<const Real>& mass, const View<const Real>& inertia, const More& more) {
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
      for (int axis = 0; axis < 6; ++axis)
        if (c.prescribes() >> axis & 1)
          for (const Index row : domain.set(c.set)) mobility.hold(row, axis);

  // Each chunk's live bonds follow those of the chunks before, whichever thread asks their law.
  struct Part {
    const PairLaw* law;
    const BondTable* table;
    Chunk chunk;
    Index begin;  // number in the network of its first bond
  };
  std::vector<Part> parts;
  Index bonds = 0;
  for (const auto& [law, table] : w.laws())
    for (const Chunk& chunk : table->chunks()) {
      parts.push_back({law, table, chunk, bonds});
      bonds += chunk.live_end - chunk.begin;
    }
  ElasticNetwork network(domain.size());
  network.resize(bonds);
  const auto position = domain.elements().column("position").view<Vec3>();
  const auto ask = [&](const Part& part) {
    const auto& [law, table, chunk, begin] = part;
    for (Index b = chunk.begin; b < chunk.live_end; ++b) {
      const Index i = table->first()[b], j = table->second()[b];
      network.set(
          begin + b - chunk.begin, i, j,
          law->tangent(domain, *table, b, Slope::stiffest) + more(*law, *table, b, Vec3(position[j] - position[i])));
    }
  };
  each_shared(parts.size(), [&](std::size_t p) { blaming(*parts[p].law, "tangent", [&] { ask(parts[p]); }); });
  if (network.bonds() == 0) return {};
  const StableStep found = stable_step(network, mobility, 1);
  if (!std::isfinite(found.dt) || found.dt == 0) refuse_too_stiff(domain, network, parts);
  StepLimit limit{found.dt, ""};
  if (!std::isfinite(found.dt)) return {};
  limit.by =
      fmt::format("limited by element {}, which {}", domain.elements().column("id").view<Index>()[found.mode.element],
                  found.mode.rotates ? "turns" : "moves");
  if (found.bound.bond >= 0) {
    const auto next = std::upper_bound(parts.begin(), parts.end(), found.bound.bond,
                                       [](Index bond, const Part& part) { return bond < part.begin; });
    limit.by += fmt::format(" (stiffest bond: one of '{}')", std::prev(next)->table->name());
  }
  return limit;
}

/// The same, or what a law wants to be resolved (PairLaw::longest_step) where that is shorter.
template <class More>
StepLimit step_limit(Workings& w, const View<const Real>& mass, const View<const Real>& inertia, const More& more) {
  StepLimit limit = elastic_limit(w, mass, inertia, more);
  for (const auto& [law, table] : w.laws()) {
    const Real longest = blaming(*law, "longest_step", [&, law = law] { return law->longest_step(w.domain()); });
    if (longest < limit.time_step)
      limit = {longest, fmt::format("limited by '{}', whose collisions are to be resolved", law->family())};
  }
  return limit;
}

}  // namespace beadwork
