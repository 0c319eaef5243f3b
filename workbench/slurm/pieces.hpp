#pragma once
// How jobs are cut into arrays, and which array waits for which. Knows nothing of Slurm but its limits.

#include <cstddef>
#include <vector>

namespace beadwork::slurm {

/// A job that is to be submitted.
struct Wanted {
  std::size_t job;
  std::vector<std::size_t> needs;  ///< jobs that have been submitted and have not ended
  std::size_t bytes;               ///< of its command
};

/// An array of them.
struct Piece {
  std::vector<std::size_t> jobs;
  std::vector<std::size_t> needs;     ///< jobs that it waits for
  std::size_t at_once = 0;            ///< 0: as many as Slurm likes
  std::vector<std::size_t> behind{};  ///< pieces of this list that it waits for
};

/// Arrays of at most `tasks` jobs and `bytes` of commands. Jobs that need the same stand together and wait for nothing
/// else, unless that made many small arrays. If at most `at_once` may be at work (0: any number), all arrays share that
/// number, and wait for all of `others`, which have been submitted before.
std::vector<Piece> pieces_of(const std::vector<Wanted>& wanted, std::size_t tasks, std::size_t bytes,
                             std::size_t at_once, const std::vector<std::size_t>& others);

}  // namespace beadwork::slurm
