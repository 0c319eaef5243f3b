#pragma once
// Section <bond>: bonds elements, one family for each law.

#include "core/plugin/pair_law.hpp"

namespace beadwork {

class BondLaw : public PairLaw {
 public:
  static constexpr Kind its_kind = Kind::bond;
  BondLaw() : PairLaw(its_kind) {}
  Param<Real> gap{
      this,
      {.name = "gap",
       .range = {0, 100},
       .doc = "Largest distance between the surfaces of two elements that are bonded, over the sum of their radii",
       .fallback = "1e-3"}};
  Param<std::string> neighbours{
      this,
      {.name = "neighbours",
       .doc =
           "Which elements are bonded. all: those within 'gap'; next: those of them over which no third lies between "
           "the two, for a row of elements that overlap; nearest: each element of the second set with the nearest of "
           "the first within 'gap', and no other; listed: those that the filling plugin lists as neighbours along a "
           "fibre, at any distance. Where absent: listed where that is done, else all",
       .optional = true,
       .choices = {"all", "next", "nearest", "listed"}}};

  /// Pairs that are to be bonded, at the start of the stage in which the family first stands.
  virtual bool accepts(const Domain&, Index, Index) const { return true; }
  /// Sets the rest state of the rows just made. Throws DeckFailure where that is impossible.
  virtual void connect(Domain& domain, BondTable& table) = 0;
  /// What the log says once of the bonds just made.
  virtual std::string remark() const { return ""; }
  /// What the log warns of once, at the bonds just made: that they will not do what the deck seems to want; "" for
  /// nothing.
  virtual std::string caution() const { return ""; }
};

}  // namespace beadwork
