#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/random.hpp"
#include "core/domain/vocabulary.hpp"
#include "core/plugin/failure.hpp"

namespace beadwork {

/// Porosity: bonds that are free of all effort from the start.   Section 4.5 of the paper; docs/theory/bond-failure.md
class Defects final : public Failure {
 public:
  static constexpr const char* about =
      "Bonds that are broken from the start, at random or in clusters: the porosity of the solid";
  Param<Real> share{
      this,
      {.name = "share",
       .range = {0, 1, false, true},
       .doc = "Share P_r of the bonds of each family; those between two elements of 'except' count for nothing"}};
  Param<Real> cluster{this,
                      {.name = "cluster",
                       .unit = "m",
                       .range = positive,
                       .doc = "Diameter of spheres at random places within which all bonds are broken; single bonds "
                              "where absent",
                       .optional = true}};
  Param<std::int64_t> seed{
      this,
      {.name = "seed", .range = {0}, .doc = "Seed of their places; that of the scene where absent", .optional = true}};
  Reads<Vec3> position{this, field::position};

  void choose() override { utilisation.want(false); }
  bool judges() const override { return false; }
  void judge(const Domain&) override {}
  std::string mode() const override { return "defect"; }

  std::vector<Index> flaws(const Domain&, const BondTable& table, std::uint64_t scene_seed) override {
    std::vector<Index> rows = candidates(table);
    const auto wanted = static_cast<std::size_t>(std::llround(*share * static_cast<Real>(rows.size())));
    Random random(seed.given() ? static_cast<std::uint64_t>(*seed) : scene_seed, stream_of(id() + "/" + table.name()));
    if (cluster.given()) return in_clusters(table, rows, wanted, random);
    for (std::size_t k = 0; k < wanted; ++k) std::swap(rows[k], rows[k + below(rows.size() - k, random)]);
    rows.resize(wanted);
    return rows;
  }

 private:
  /// In the order of the ids, so that how rows are stored changes nothing.
  std::vector<Index> candidates(const BondTable& table) const {
    std::vector<Index> rows;
    for (Index row = 0; row < table.size(); ++row)
      if (table.state()[row] != State::broken && !(spares_some() && spares(table, row))) rows.push_back(row);
    std::sort(rows.begin(), rows.end(), [&](Index a, Index b) { return table.id()[a] < table.id()[b]; });
    return rows;
  }
  static std::size_t below(std::size_t count, Random& random) {
    return std::min(count - 1, static_cast<std::size_t>(random.uniform() * static_cast<Real>(count)));
  }
  Vec3 middle(const BondTable& table, Index row) const {
    return 0.5 * (position[table.first()[row]] + position[table.second()[row]]);
  }

  /// Around bonds chosen at random, sphere after sphere; of the last one those that are nearest to its centre.
  std::vector<Index> in_clusters(const BondTable& table, const std::vector<Index>& rows, std::size_t wanted,
                                 Random& random) const {
    std::vector<Index> flaws;
    std::vector<char> taken(static_cast<std::size_t>(table.size()), 0);
    while (flaws.size() < wanted) {
      const Vec3 centre = middle(table, rows[below(rows.size(), random)]);
      std::vector<std::pair<Real, Index>> found;
      for (const Index row : rows)
        if (const Real far = (middle(table, row) - centre).norm();
            !taken[static_cast<std::size_t>(row)] && far <= *cluster / 2)
          found.emplace_back(far, row);
      std::sort(found.begin(), found.end());
      for (const auto& [far, row] : found) {
        if (flaws.size() == wanted) break;
        flaws.push_back(row);
        taken[static_cast<std::size_t>(row)] = 1;
      }
    }
    return flaws;
  }
};

}  // namespace beadwork
