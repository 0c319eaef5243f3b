#pragma once
// Bodies that hang together by bonds and that no load holds as a whole: they are named when a stage begins, and how far
// each goes that way is followed. What nobody holds rolls and drifts of the least cause. docs/theory/quasi-static.md

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "core/mechanics/rigid_modes.hpp"
#include "core/plugin/kinds.hpp"

namespace beadwork {

class FreeMotions {
 public:
  /// Bodies of two elements and more, the largest first, as they are bonded by `tables` and held by `constraints` at
  /// this step; `turning`: elements have orientations. Where there are any, the elements get columns of where they
  /// stand now, and in which body.
  static FreeMotions find(Domain& domain, std::span<const BondTable* const> tables,
                          std::span<const Constraint> constraints, bool turning, std::int64_t step);

  /// For the log: the largest bodies by name, the others by number.
  std::vector<std::string> words() const;
  bool any() const { return !bodies_.empty(); }
  /// The farthest that an element stands from where it began by free motions of its body alone [m]: exact for small
  /// turns.
  Real moved(const Domain& domain) const;

  nlohmann::ordered_json json() const;  ///< for summary.json
  nlohmann::ordered_json saved() const;
  /// Nothing where that is not whole, or does not fit the columns of the elements.
  static std::optional<FreeMotions> restored(const nlohmann::ordered_json& saved, const Domain& domain);

 private:
  struct Body {
    Index elements = 0;
    std::vector<std::string> motions;
    RigidModes modes;  // orthonormal
    Vec3 centre = Vec3::Zero();
    Real length = 0;  // of the body [m]
  };
  void follow(Domain& domain, const std::vector<std::vector<Index>>& members) const;
  std::vector<Rigid> motions(const Domain& domain) const;
  static Body body_of(const nlohmann::ordered_json& saved);

  std::vector<Body> bodies_;  // those that are named and followed
  std::size_t others_ = 0;    // smaller ones
};

}  // namespace beadwork
