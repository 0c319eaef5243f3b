#pragma once
// What came of a scene of two elements: the response of the bond, and what is read off it.

#include <optional>
#include <vector>

#include "core/plugin/runner.hpp"
#include "workbench/law/pair.hpp"

namespace beadwork::law {

/// Row by row, each an equilibrium.
struct Response {
  std::vector<Real> motion, load;              ///< s, and what does work on it
  std::vector<Real> work, stored, dissipated;  ///< [J]

  std::size_t rows() const { return motion.size(); }
};

Response response_of(const Outcome& outcome, const Mode& mode);

/// What a search has found.
struct Found {
  Real stiffness = 0;             ///< at the beginning
  Real peak = 0, peak_at = 0;     ///< of the load by its size, with its sign; and s there
  std::optional<Real> failed_at;  ///< s from which on it bears nothing
  bool softens = false;           ///< the peak lies before the end
};

/// `scale`: that of its motions, a distance or 1 rad.
Found found_in(const Response& search, Real scale);

/// How far the cycles go, one after the other: below the peak, between the peak and failure, beyond failure; or, of what
/// does not fail, in equal parts as far as the mode shows.
std::vector<Real> amplitudes(const Found& found, const Mode& mode, const Pair& pair);

/// Of the cycles themselves, which sample a peak and a failure as the search does not.
struct Figures {
  Real peak = 0, peak_at = 0, dissipated = 0;
};
Figures figures_of(const Response& cycles);

}  // namespace beadwork::law
