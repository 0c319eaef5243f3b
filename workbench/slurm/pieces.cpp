#include "workbench/slurm/pieces.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace beadwork::slurm {

namespace {

constexpr std::size_t most_groups = 64;  // each costs a call of sbatch

using Group = std::vector<const Wanted*>;

/// Those that need the same, in the order in which they are met; all in one where these were many.
std::vector<Group> groups_of(const std::vector<Wanted>& wanted, bool apart) {
  std::map<std::vector<std::size_t>, std::size_t> index;
  std::vector<Group> groups;
  for (const Wanted& each : wanted) {
    const auto [found, is_new] = index.emplace(apart ? each.needs : std::vector<std::size_t>{}, groups.size());
    if (is_new) groups.emplace_back();
    groups[found->second].push_back(&each);
  }
  return groups.size() > most_groups ? groups_of(wanted, false) : groups;
}

void cut(const Group& group, std::size_t tasks, std::size_t bytes, std::vector<Piece>& pieces) {
  std::size_t taken = 0;
  for (std::size_t k = 0; k < group.size(); ++k) {
    if (k == 0 || pieces.back().jobs.size() == tasks || taken + group[k]->bytes > bytes) {
      pieces.emplace_back();
      taken = 0;
    }
    Piece& piece = pieces.back();
    piece.jobs.push_back(group[k]->job);
    piece.needs.insert(piece.needs.end(), group[k]->needs.begin(), group[k]->needs.end());
    taken += group[k]->bytes;
  }
}

void keep_once_each(std::vector<std::size_t>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

/// Where there are more arrays than may be at work at once, the later ones stand behind earlier ones.
void share_out(std::vector<Piece>& pieces, std::size_t at_once) {
  const std::size_t beside = std::min(pieces.size(), at_once);
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    pieces[k].at_once = at_once / beside + (k % beside < at_once % beside ? 1 : 0);
    if (k >= beside) pieces[k].behind.push_back(k - beside);
  }
}

}  // namespace

std::vector<Piece> pieces_of(const std::vector<Wanted>& wanted, std::size_t tasks, std::size_t bytes,
                             std::size_t at_once, const std::vector<std::size_t>& others) {
  std::vector<Piece> pieces;
  for (const Group& group : groups_of(wanted, at_once == 0)) cut(group, tasks, bytes, pieces);
  if (at_once > 0) {
    share_out(pieces, at_once);
    for (Piece& piece : pieces) piece.needs.insert(piece.needs.end(), others.begin(), others.end());
  }
  for (Piece& piece : pieces) keep_once_each(piece.needs);
  return pieces;
}

}  // namespace beadwork::slurm
