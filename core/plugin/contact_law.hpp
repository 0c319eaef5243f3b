#pragma once
// Section <contact>: acts between elements that touch and are not bonded.

#include "core/domain/vocabulary.hpp"
#include "core/plugin/pair_law.hpp"

namespace beadwork {

/// Pairs whose surfaces are within a skin of one another are rows of a table, which is renewed when something has moved
/// by half the skin; rows of pairs that stay keep what they remember.
class ContactLaw : public PairLaw {
 public:
  static constexpr Kind its_kind = Kind::contact;
  ContactLaw() : PairLaw(its_kind) {}
  Param<Real> skin{this,
                   {.name = "skin",
                    .range = {0, 10, true, false},
                    .doc = "Distance of surfaces up to which a pair is followed before it touches, over the smallest "
                           "radius: the wider, the more pairs are looked at and the seldomer they are searched",
                    .fallback = "0.3"}};
  Reads<Real> radius{this, field::radius};
  Keeps<Real> length{this, field::contact_length};
  Keeps<Vec3> searched_at{this, field::searched_at};

  bool acts_when_broken() const final { return true; }  // it has no bonds that break
  bool is_in_stress() const override { return false; }

  /// A pair is followed from here on: its length is set, the rest of its row is zero.
  virtual void meet(const Domain&, const BondTable&, Index /*row*/) {}
  /// It is followed no longer; it does not touch. What it has dissipated is to be kept.
  virtual void part(const BondTable&, Index /*row*/) {}
};

}  // namespace beadwork
