#include <fmt/format.h>

#include "core/base/failure.hpp"
#include "core/base/units.hpp"
#include "core/domain/vocabulary.hpp"
#include "core/plugin/kinds.hpp"

namespace beadwork {

/// A set of the elements whose centres fulfil a condition, found once after filling.
class Region final : public Filler {
 public:
  static constexpr const char* about =
      "Names the elements for which a condition on their centre and radius holds, once after filling; walls are none";
  Param<std::string> set{this, {.name = "set", .doc = "Name of the new set", .role = Role::makes_set}};
  Param<std::string> of{this,
                        {.name = "of",
                         .doc = "Only elements of this set; of all elements where absent",
                         .optional = true,
                         .role = Role::set}};
  Param<Formula> where{this,
                       {.name = "where",
                        .unit = "",
                        .doc = "Condition on x, y, z and radius, such as \"x < 13.5 mm and z > 0 mm\"",
                        .variables = {{"x", length()}, {"y", length()}, {"z", length()}, {"radius", length()}}}};

  bool after_filling() const override { return true; }

  void fill(Domain& domain, const FillJob& job) override {
    const auto position = domain.elements().column("position").view<Vec3>();
    const auto radius = domain.elements().column("radius").view<Real>();
    Set members;
    const auto look = [&](Index row) {
      if (row % 4096 == 0) job.pause();
      if (domain.walls().is_wall(row)) return;
      const Vec3 x = position[row];
      const Real values[] = {x.x(), x.y(), x.z(), radius[row]};
      if ((*where)(values) == 1) members.push_back(row);
    };
    if (of.given())
      for (const Index row : domain.set(*of)) look(row);
    else
      for (Index row = 0; row < domain.size(); ++row) look(row);
    if (members.empty())
      refuse(where.at(), fmt::format("set '{}' is empty: no element fulfils \"{}\"", *set, where->text));
    domain.sets()[*set] = std::move(members);
  }

 private:
  static Dimension length() { return find_unit("m")->dimension; }
};

}  // namespace beadwork
