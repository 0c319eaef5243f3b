#include "core/loop/connect.hpp"

#include <fmt/format.h>

#include "core/base/failure.hpp"
#include "core/domain/neighbours.hpp"

namespace beadwork {

namespace {

std::vector<char> membership(const Domain& domain, const std::string& set) {
  std::vector<char> member(static_cast<std::size_t>(domain.size()), 0);
  for (const Index row : domain.set(set)) member[static_cast<std::size_t>(row)] = 1;
  return member;
}

}  // namespace

std::vector<std::pair<Index, Index>> pairs_to_bond(const BondLaw& law, const Domain& domain) {
  const std::vector<char> one = membership(domain, (*law.between)[0]);
  const std::vector<char> other = membership(domain, (*law.between)[1]);
  std::vector<Vec3> position;
  std::vector<Real> radius;
  std::vector<Index> row_of;  // only the elements of the two sets are searched
  const auto x = domain.elements().column("position").view<Vec3>();
  const auto r = domain.elements().column("radius").view<Real>();
  for (Index row = 0; row < domain.size(); ++row) {
    if (!one[static_cast<std::size_t>(row)] && !other[static_cast<std::size_t>(row)]) continue;
    position.push_back(x[row]);
    radius.push_back(r[row]);
    row_of.push_back(row);
  }
  std::vector<std::pair<Index, Index>> pairs;
  for (const Pair& near : find_pairs(position, radius, *law.gap)) {
    const auto i = static_cast<std::size_t>(row_of[static_cast<std::size_t>(near.i)]);
    const auto j = static_cast<std::size_t>(row_of[static_cast<std::size_t>(near.j)]);
    const bool joins = (one[i] && other[j]) || (one[j] && other[i]);
    if (joins && law.accepts(domain, static_cast<Index>(i), static_cast<Index>(j)))
      pairs.emplace_back(static_cast<Index>(i), static_cast<Index>(j));
  }
  if (pairs.empty())
    refuse(law.at(), fmt::format("family '{}' has no bond: no element of '{}' touches one of '{}', also with 'gap' = {} of the sum of "
                                 "their radii between them; a larger 'gap' or another set may help",
                                 *law.name, (*law.between)[0], (*law.between)[1], law.gap.value()));
  return pairs;
}

}  // namespace beadwork
