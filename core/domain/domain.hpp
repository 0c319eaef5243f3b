#pragma once
// What is simulated: elements, families of bonds between them, named sets, and numbers of the scene.

#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/domain/bond_table.hpp"
#include "core/domain/break_log.hpp"
#include "core/domain/pair_list.hpp"
#include "core/domain/walls.hpp"

namespace beadwork {

/// Far more than a machine holds, and few enough that the bonds of a solid, and the rows beyond its elements, can be
/// numbered too.
inline constexpr Index most_elements = std::numeric_limits<Index>::max() / 16;

/// Rows of the element table, ascending.
using Set = std::vector<Index>;

class Domain {
 public:
  Domain();

  Table& elements() { return elements_; }
  const Table& elements() const { return elements_; }
  Table& scene() { return scene_; }
  const Table& scene() const { return scene_; }
  Index size() const { return elements_.size(); }
  /// What else the scene remembers by the row: of its constraints, its watchers, its criteria. Made if need be.
  Table& list(const std::string& name);
  const std::map<std::string, Table>& lists() const { return lists_; }
  std::map<std::string, Table>& lists() { return lists_; }

  /// Appends elements at rest, unturned; their other columns are zero. Returns the first new row.
  Index add_elements(Index count);
  /// New row i takes what stood in row order[i]; sets and lists of pairs follow.
  void reorder(const std::vector<Index>& order);

  std::map<std::string, Set>& sets() { return sets_; }
  /// Throws std::logic_error for an unknown name.
  const Set& set(const std::string& name) const;
  /// Neighbours that filling plugins list, by the name of the set that they are of.
  std::map<std::string, PairList>& pairs() { return pairs_; }
  const std::map<std::string, PairList>& pairs() const { return pairs_; }

  BondTable& add_family(const std::string& name);
  /// A family whose pairs touch without being bonded, and come and go.
  BondTable& add_contacts(const std::string& name);
  BondTable* find_family(const std::string& name);
  const BondTable* find_family(const std::string& name) const;
  const std::vector<std::unique_ptr<BondTable>>& families() { return families_; }
  const std::vector<const BondTable*>& families() const { return shown_; }
  Index bonds() const;

  /// Where an element stands, and how it is turned; unturned where nothing turns.
  Pose pose(Index row) const;
  Walls& walls() { return walls_; }
  const Walls& walls() const { return walls_; }

  BreakLog& breaks() { return breaks_; }
  const BreakLog& breaks() const { return breaks_; }
  const std::map<std::string, Set>& sets() const { return sets_; }

  /// Cuts every family into chunks and gives the force line its halo rows.
  void cut_families();
  /// Adds the halo rows to their elements. To be called once all families have acted.
  void gather();
  /// The same for the other sums (Column::summed), which are cleared before.
  void clear_sums();
  void gather_sums();
  /// Sets all forces and torques to zero.
  void clear_loads();
  /// Sets the halo rows to zero: for what adds to forces that have been gathered already, and gathers again.
  void clear_halo();

 private:
  std::vector<Column*> sums();
  Table elements_{Table::Layout::rows};
  Table scene_{Table::Layout::rows};
  std::map<std::string, Table> lists_;
  std::map<std::string, Set> sets_;
  std::map<std::string, PairList> pairs_;
  std::vector<std::unique_ptr<BondTable>> families_;
  std::vector<const BondTable*> shown_;  ///< the same, to those who may only look
  Walls walls_;
  BreakLog breaks_;
  struct Share {
    Index element, begin, end;  ///< halo rows `shares_[begin..end)` belong to `element`
  };
  std::vector<Share> shares_;
  std::vector<Index> share_rows_;
};

}  // namespace beadwork
