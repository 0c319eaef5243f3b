#include "core/loop/connect.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <new>
#include <stdexcept>

#include "core/base/failure.hpp"
#include "core/domain/neighbours.hpp"
#include "core/domain/reach.hpp"
#include "core/plugin/blame.hpp"

namespace beadwork {

namespace {

std::vector<char> membership(const Domain& domain, const std::string& set) {
  std::vector<char> member(static_cast<std::size_t>(domain.size()), 0);
  for (const Index row : domain.set(set)) member[static_cast<std::size_t>(row)] = 1;
  return member;
}

/// The elements of the two sets, which alone are searched, and the pairs among them.
struct Candidates {
  std::vector<Vec3> position;
  std::vector<Real> radius;
  std::vector<Index> row_of;
  std::vector<Pair> pairs;

  Index row(Index k) const { return row_of[static_cast<std::size_t>(k)]; }
};

/// The elements of the two sets between which a law acts, and the pairs that `find` finds among them and that join the two.
template <class Find>
Candidates candidates(const PairLaw& law, const Domain& domain, const Find& find) {
  const std::vector<char> one = membership(domain, (*law.between)[0]);
  const std::vector<char> other = membership(domain, (*law.between)[1]);
  Candidates among;
  const auto x = domain.elements().column("position").view<Vec3>();
  const auto r = domain.elements().column("radius").view<Real>();
  for (Index row = 0; row < domain.size(); ++row) {
    if (!one[static_cast<std::size_t>(row)] && !other[static_cast<std::size_t>(row)]) continue;
    among.position.push_back(x[row]);
    among.radius.push_back(r[row]);
    among.row_of.push_back(row);
  }
  for (const Pair& near : find(among)) {
    const auto i = static_cast<std::size_t>(among.row(near.i)), j = static_cast<std::size_t>(among.row(near.j));
    if ((one[i] && other[j]) || (one[j] && other[i])) among.pairs.push_back(near);
  }
  return among;
}

/// Of the pairs of each element of the second set that with the nearest of the first, surface to surface; of equally
/// near ones that of the lowest id, so that how rows are stored changes nothing.
void keep_nearest(const BondLaw& law, const Domain& domain, Candidates& among) {
  const std::vector<char> one = membership(domain, (*law.between)[0]);
  const auto id = domain.elements().column("id").view<Index>();
  for (const Index row : domain.set((*law.between)[1]))
    if (one[static_cast<std::size_t>(row)])
      refuse(law.between.at(),
             fmt::format("element {} is in both sets: neighbours=\"nearest\" wants two that have none "
                         "in common",
                         id[row]));
  struct Best {
    Real distance;
    Index other;
    std::size_t pair;
  };
  std::map<Index, Best> best;  // by the element of the second set
  for (std::size_t p = 0; p < among.pairs.size(); ++p) {
    const auto i = static_cast<std::size_t>(among.pairs[p].i), j = static_cast<std::size_t>(among.pairs[p].j);
    const Real distance = (among.position[j] - among.position[i]).norm() - (among.radius[i] + among.radius[j]);
    const bool first_is_one = one[static_cast<std::size_t>(among.row(among.pairs[p].i))];
    const Index other = first_is_one ? among.row(among.pairs[p].i) : among.row(among.pairs[p].j);
    const Index element = first_is_one ? among.row(among.pairs[p].j) : among.row(among.pairs[p].i);
    const auto [there, fresh] = best.try_emplace(element, Best{distance, id[other], p});
    if (!fresh && std::pair(distance, id[other]) < std::pair(there->second.distance, there->second.other))
      there->second = {distance, id[other], p};
  }
  std::vector<char> kept(among.pairs.size(), 0);
  for (const auto& [element, found] : best) kept[found.pair] = 1;
  std::size_t last = 0;
  for (std::size_t p = 0; p < kept.size(); ++p)
    if (kept[p]) among.pairs[last++] = among.pairs[p];
  among.pairs.resize(last);
}

/// The pairs that a filling plugin lists of the set, which both ends of the law are of.
const PairList* listed_pairs(const BondLaw& law, const Domain& domain) {
  const auto found = domain.pairs().find((*law.between)[0]);
  return (*law.between)[0] == (*law.between)[1] && found != domain.pairs().end() ? &found->second : nullptr;
}

/// Members of the set that stand in no pair of its list.
std::ptrdiff_t unlisted(const BondLaw& law, const Domain& domain) {
  std::vector<char> listed(static_cast<std::size_t>(domain.size()), 0);
  for (const auto& [first, second] : *listed_pairs(law, domain))
    listed[static_cast<std::size_t>(first)] = listed[static_cast<std::size_t>(second)] = 1;
  const Set& set = domain.set((*law.between)[0]);
  return std::count_if(set.begin(), set.end(), [&](Index row) { return !listed[static_cast<std::size_t>(row)]; });
}

std::string neighbours_of(const BondLaw& law, const Domain& domain) {
  if (!law.neighbours.given()) return listed_pairs(law, domain) && unlisted(law, domain) == 0 ? "listed" : "all";
  if (*law.neighbours == "listed" && !listed_pairs(law, domain))
    refuse(
        law.neighbours.at(),
        fmt::format("no neighbours are listed of '{}' and '{}': that is done by fillings that make fibres, of the one "
                    "set that they make",
                    (*law.between)[0], (*law.between)[1]));
  return *law.neighbours;
}

void mind_unlisted(const BondLaw& law, const Domain& domain, const Log& log) {
  const auto without = unlisted(law, domain);
  if (without > 0)
    log.warn(
        fmt::format("{}: {} elements of set '{}' are in no list of neighbours, and have no bond of family '{}': "
                    "neighbours=\"all\" or \"next\" bonds by distance",
                    law.at().where(), without, (*law.between)[0], *law.name));
}

Candidates listed_ones(const BondLaw& law, const Domain& domain) {
  Candidates among = candidates(law, domain, [](const Candidates&) { return std::vector<Pair>{}; });
  std::vector<Index> place(static_cast<std::size_t>(domain.size()), -1);
  for (std::size_t k = 0; k < among.row_of.size(); ++k)
    place[static_cast<std::size_t>(among.row_of[k])] = static_cast<Index>(k);
  for (const auto& [first, second] : *listed_pairs(law, domain))
    among.pairs.push_back({place[static_cast<std::size_t>(first)], place[static_cast<std::size_t>(second)]});
  return among;
}

Candidates near_ones(const BondLaw& law, const std::string& which, const Domain& domain, const Pause& pause) {
  const Location& at = law.gap.in_deck() ? law.gap.at() : law.at();
  try {
    Candidates among =
        which == "listed" ? listed_ones(law, domain) : candidates(law, domain, [&](const Candidates& all) {
          return find_pairs(all.position, all.radius, *law.gap, 0, pause);
        });
    if (which == "nearest") keep_nearest(law, domain, among);
    std::erase_if(among.pairs, [&](const Pair& near) {
      return !blaming(law, "accepts", [&] { return law.accepts(domain, among.row(near.i), among.row(near.j)); });
    });
    return among;
  } catch (const std::invalid_argument& too_many) {
    refuse(at, fmt::format("family '{}': {}", *law.name, too_many.what()));
  } catch (const std::bad_alloc&) {
    refuse(at, fmt::format("family '{}': there is not enough memory for the pairs that stand within this 'gap'",
                           *law.name));
  }
}

/// Leaves out the pairs that reach over a third element where the law bonds the next only, and warns of them where it
/// does not.
void mind_far_ones(const BondLaw& law, const std::string& which, Candidates& among, const Pause& pause,
                   const Log& log) {
  const std::vector<Index> between = elements_between(among.position, among.radius, among.pairs, pause);
  const auto far = std::count_if(between.begin(), between.end(), [](Index k) { return k >= 0; });
  if (far == 0) return;
  if (which == "next") {
    std::size_t kept = 0;
    for (std::size_t p = 0; p < between.size(); ++p)
      if (between[p] < 0) among.pairs[kept++] = among.pairs[p];
    among.pairs.resize(kept);
    return;
  }
  log.warn(
      fmt::format("{}: {} of the {} bonds of family '{}' reach over an element that lies between the two, since "
                  "elements overlap or 'gap' is wide: they add to its stiffness; neighbours=\"next\" leaves them out",
                  law.at().where(), far, among.pairs.size(), *law.name));
}

/// Elements of one set and the facets of the walls of the other.
std::vector<Near> walls_in_reach(const ContactLaw& law, const Domain& domain, Real skin) {
  const auto x = domain.elements().column("position").view<Vec3>();
  const auto r = domain.elements().column("radius").view<Real>();
  std::vector<Index> rows, walls;
  std::vector<Vec3> place;
  std::vector<Real> reach;
  std::vector<Pose> poses;
  for (const std::string& name : *law.between)
    for (const Index row : domain.set(name)) {
      if (domain.walls().is_wall(row)) {
        walls.push_back(row);
        poses.push_back(domain.pose(row));
      } else {
        rows.push_back(row);
        place.push_back(x[row]);
        reach.push_back(r[row] + skin);
      }
    }
  std::vector<Near> pairs = domain.walls().near(place, reach, walls, poses);
  for (Near& pair : pairs) pair.first = rows[static_cast<std::size_t>(pair.first)];  // ascending, as sets are
  return pairs;
}

}  // namespace

bool has_pairs(const BondLaw& law, const Domain& domain, const Pause& pause) {
  return !near_ones(law, neighbours_of(law, domain), domain, pause).pairs.empty();
}

std::vector<std::pair<Index, Index>> pairs_to_bond(const BondLaw& law, const Domain& domain, const Pause& pause,
                                                   const Log& log) {
  const std::string which = neighbours_of(law, domain);
  Candidates among = near_ones(law, which, domain, pause);
  if (among.pairs.empty())
    refuse(law.at(), fmt::format("family '{}' has no bond: no element of '{}' touches one of '{}', also with 'gap' = "
                                 "{} of the sum of their radii between them; a larger 'gap' or another set may help",
                                 *law.name, (*law.between)[0], (*law.between)[1], law.gap.value()));
  if (which == "listed") mind_unlisted(law, domain, log);
  if (which == "all" || which == "next") mind_far_ones(law, which, among, pause, log);
  std::vector<std::pair<Index, Index>> pairs;
  pairs.reserve(among.pairs.size());
  for (const Pair& pair : among.pairs) pairs.emplace_back(among.row(pair.i), among.row(pair.j));
  return pairs;
}

std::vector<Near> pairs_in_reach(const ContactLaw& law, const Domain& domain, Real skin) {
  if (law.faces_walls()) return walls_in_reach(law, domain, skin);
  const Candidates among =
      candidates(law, domain, [&](const Candidates& all) { return find_pairs(all.position, all.radius, 0, skin); });
  std::vector<Near> pairs;
  pairs.reserve(among.pairs.size());
  for (const Pair& pair : among.pairs) pairs.push_back({among.row(pair.i), among.row(pair.j)});
  return pairs;
}

}  // namespace beadwork
