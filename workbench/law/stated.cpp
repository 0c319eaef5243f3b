#include "workbench/law/stated.hpp"

#include <fmt/format.h>

#include <optional>

#include "core/base/failure.hpp"
#include "core/base/text.hpp"
#include "core/loop/filling.hpp"
#include "core/loop/stage_start.hpp"

namespace beadwork::law {

namespace {

// Of every filling that makes elements; nothing where one of them does not say, or says another.
std::optional<Real> one_radius(const Scene& scene) {
  std::optional<Real> found;
  for (const Filler* filler : scene.fillers) {
    if (filler->makes_walls() || filler->after_filling()) continue;
    const ParamBase* radius = filler->param("radius");
    if (!radius || !radius->given()) return {};
    const auto value = parse_number(split_words(radius->text()).front());  // in SI
    if (!value || (found && *found != *value)) return {};
    found = value;
  }
  return found;
}

Real mean_radius(const Domain& domain, const std::string& set) {
  const auto radius = domain.elements().column("radius").view<Real>();
  Real sum = 0, count = 0;
  for (const Index row : domain.set(set))
    if (!domain.walls().is_wall(row)) sum += radius[row], ++count;
  if (count == 0) throw DeckFailure(fmt::format("error: set '{}' has no elements with a radius: give --radius", set));
  return sum / count;
}

}  // namespace

Real stated_stiffness(const DeckRequest& deck, const Family& family, const Mode& mode) {
  if (family.is_contact) return 0;  // where it only just touches it has none
  Complaints complaints;
  const Loaded loaded = load_scene(deck, complaints);
  complaints.throw_if_any();
  RunState state(*loaded.scene);
  loaded.scene->bind();
  const RunOptions options;
  std::vector<std::string> reports;
  fill(state, options, reports);
  create_families(state, options);
  let_laws_act(state);
  connect(state, options.log);
  const Eigen::Map<const Eigen::Matrix<Real, 12, 1>> moves(mode.moves.data());
  const auto& [law, table] = state.laws.front();
  return moves.dot(law->tangent(state.domain(), *table, 0, Slope::secant) * moves);
}

std::vector<Pair> pairs_of(const Loaded& loaded, const std::vector<Family>& families, const RunOptions& filling,
                           const Log& log) {
  if (const auto radius = one_radius(*loaded.scene)) return std::vector<Pair>(families.size(), Pair{*radius, *radius});
  log.say("filling the scene for the radii of its elements (--radius R spares that)");
  RunState state(*loaded.scene);
  loaded.scene->bind();
  std::vector<std::string> reports;
  fill(state, filling, reports);
  std::vector<Pair> pairs;
  for (const Family& family : families)
    pairs.push_back({mean_radius(state.domain(), family.between[0]), mean_radius(state.domain(), family.between[1])});
  return pairs;
}

}  // namespace beadwork::law
