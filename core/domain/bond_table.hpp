#pragma once
// One family of bonds, cut into chunks.
//
// Elements are cut into blocks of equal length, and chunk c holds the bonds whose first element lies in block c, in the
// order of their ids. A chunk adds its forces to the rows of its own block directly, in that order; forces on elements
// of other blocks go to rows of the chunk's own beyond the elements (its halo), which are added to their elements
// afterwards in a fixed order. So no two chunks write one row, nothing is stored per bond, and the sums do not depend
// on how many threads share the chunks.

#include <string>
#include <utility>
#include <vector>

#include "core/domain/near.hpp"
#include "core/domain/table.hpp"

namespace beadwork {

/// Length of the blocks into which `elements` are cut: from their number alone.
Index block_length(Index elements);
Index block_count(Index elements);

struct Chunk {
  Index begin = 0;     ///< first bond
  Index live_end = 0;  ///< bonds from here on are broken and take part in nothing
  Index end = 0;
  Index halo_begin = 0;  ///< rows of the force line that this chunk alone writes
  Index halo_end = 0;
};

class BondTable {
 public:
  explicit BondTable(std::string name);

  const std::string& name() const { return name_; }
  Table& rows() { return rows_; }
  const Table& rows() const { return rows_; }
  Index size() const { return rows_.size(); }
  Index live() const;
  /// Its pairs come and go: they are contacts, not bonds.
  void let_pairs_come_and_go() { contacts_ = true; }
  bool is_of_contacts() const { return contacts_; }

  /// Broken bonds of this family still act: they are not swept behind the live ones.
  void keep_broken_live() { broken_act_ = true; }

  /// Makes one row per pair, first < second, sorted by (first, second); ids count from `first_id`.
  void create(std::vector<std::pair<Index, Index>> pairs, Index first_id);
  /// Its pairs are of elements with walls, and tell which facet of the wall is meant.
  void let_pairs_be_with_walls();
  bool is_of_walls() const { return static_cast<bool>(facet_); }
  /// The pair that stands in a row.
  Near near(Index row) const {
    return {first_[row], second_[row],
            facet_ && facet_[row] >= 0 && facet_[row] < 2e9 ? static_cast<Index>(facet_[row]) : Index{-1}};
  }
  /// Takes other pairs in place of its own, first < second, sorted; what is known of a pair that stays goes with it, all
  /// else is zero. Returns the rows of pairs that are new. To be cut anew.
  std::vector<Index> renew(const std::vector<Near>& pairs);
  /// Cuts into chunks for that many elements; halo rows count from `halo_begin`. Returns the end of the halo rows.
  /// Kept columns alone decide the result, so it may be called again after a restart.
  Index cut(Index elements, Index halo_begin);
  /// (element, halo row) of every halo row, in the order in which they are to be added.
  const std::vector<std::pair<Index, Index>>& halo() const { return halo_; }

  const std::vector<Chunk>& chunks() const { return chunks_; }
  View<const Index> first() const { return first_; }
  View<const Index> second() const { return second_; }
  /// Row of the force line that takes the second element's share: its own, or one of the halo.
  View<const Index> target() const { return target_; }
  View<const Index> id() const { return id_; }
  View<State> state() { return state_; }
  View<const State> state() const { return state_; }
  /// Fetches the views anew after rows have moved.
  void rebind();

  /// Moves rows whose state is `broken` behind the live ones of their chunk; the order of ids among the live rows,
  /// and so every sum, stays. Views stay valid.
  void sweep();

 private:
  std::string name_;
  Table rows_{Table::Layout::planes};
  std::vector<Chunk> chunks_;
  std::vector<std::pair<Index, Index>> halo_;
  View<Index> first_, second_, target_, id_;
  View<State> state_;
  View<Real> facet_;  ///< a Real, as laws read nothing else of a row
  bool broken_act_ = false;
  bool contacts_ = false;
};

}  // namespace beadwork
