#pragma once
// Section <contact>: acts between elements that touch and are not bonded, or between elements and walls.

#include "core/domain/vocabulary.hpp"
#include "core/plugin/pair_law.hpp"

namespace beadwork {

/// Pairs whose surfaces are within a skin of one another are rows of a table, which is renewed when something has moved
/// by half the skin; rows of pairs that stay keep what they remember.
class ContactLaw : public PairLaw {
 public:
  static constexpr Kind its_kind = Kind::contact;
  ContactLaw() : PairLaw(its_kind) { facet.want(false); }
  Param<Real> skin{this,
                   {.name = "skin",
                    .range = {0, 10, true, false},
                    .doc = "Distance of surfaces up to which a pair is followed before it touches, over the smallest "
                           "radius: the wider, the more pairs are looked at and the seldomer they are searched",
                    .fallback = "0.3"}};
  Reads<Real> radius{this, field::radius};
  Keeps<Real> length{this, field::contact_length};
  Keeps<Real> facet{this, field::facet};
  Keeps<Vec3> searched_at{this, field::searched_at};

  bool acts_when_broken() const final { return true; }  // it has no bonds that break
  bool is_in_stress() const override { return false; }

  /// Told before `choose`: one of its two sets is of walls. The second element of its pairs is then the wall. `turning`: loads
  /// or forces may turn some.
  void face_walls(bool turning) {
    faces_walls_ = true;
    walls_turn_ = turning;
    facet.want(true);
  }
  bool faces_walls() const final { return faces_walls_; }
  bool faces_walls_that_turn() const { return walls_turn_; }
  /// Told before it acts, of a law that faces walls.
  void see(const Walls& walls) { facets_ = walls.facets(); }

  /// A pair is followed from here on: its length is set, the rest of its row is zero.
  virtual void meet(const Domain&, const BondTable&, Index /*row*/) {}
  /// It is followed no longer; it does not touch. What it has dissipated is to be kept.
  virtual void part(const BondTable&, Index /*row*/) {}

 protected:
  const FacetViews& facets() const { return facets_; }

 private:
  bool faces_walls_ = false, walls_turn_ = false;
  FacetViews facets_;
};

}  // namespace beadwork
