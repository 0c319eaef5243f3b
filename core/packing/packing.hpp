#pragma once
// Filling a volume with elements in the paper's three steps (section 2.2.2), each a function on a Packing:
//
//   Packing packing = free_filling(request);  // at random, without interpenetration, until nothing more fits
//   forced_filling(packing, {...});           // the rest with interpenetration, re-arranged, until Z is reached
//   relaxation(packing, {...});               // interpenetration down to round-off, elements inside the walls
//
// The method and its measured figures: docs/theory/packing.md. All results are the same to the bit for any
// number of threads. Lengths are in any one unit.

#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/base/pause.hpp"
#include "core/base/types.hpp"
#include "core/packing/radii.hpp"
#include "core/packing/region.hpp"

namespace beadwork::packing {

/// A request that is well formed but could not be met; the message names the quantity and a remedy. Malformed
/// requests throw std::invalid_argument.
struct PackingFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Hears how far a step has come, in words: called now and then.
using Tell = std::function<void(const std::string&)>;

/// Elements that are already there. They do not move and may overlap one another and the walls.
struct Obstacles {
  std::vector<Vec3> position;
  std::vector<Real> radius;
};

struct Request {
  Region region;
  /// Exactly one of the two: the mean radius follows from the count (which then comes out exactly), or the
  /// count from the mean radius (which then comes out within 2 %).
  std::optional<std::int64_t> count;
  std::optional<Real> mean_radius;
  Dispersion dispersion;
  Obstacles around;
  std::uint64_t seed = 1;
  /// Free filling ends after so many failed tries in a row.
  int tries = 20000;
  Pause pause = never_paused;
  Tell tell = [](const std::string&) {};
};

struct Packing {
  Region region;
  Dispersion dispersion;
  Obstacles around;
  std::uint64_t seed = 1;
  std::vector<Vec3> position;
  std::vector<Real> radius;
  std::vector<Real> waiting;  ///< radii of the elements that found no place yet
  Real seconds = 0;
  std::vector<std::string> warnings;
  Pause pause = never_paused;
  Tell tell = [](const std::string&) {};
};

/// Random sequential insertion without interpenetration, until the count is reached or nothing more fits.
Packing free_filling(const Request&);

struct ForcedFilling {
  Real coordination = 6.2;  ///< contacts of an element with other elements, mean over those that count
  Real tolerance = 0.3;     ///< largest overlap / (R1 + R2) of an element when it is inserted
  bool bulk = false;        ///< those in the bulk alone count: farther than 3 mean radii from walls and obstacles
  bool balanced =
      false;  ///< radii near obstacles are adapted, within the law's range, until elements are pressed alike
};
/// Places the waiting elements and re-arranges all; then all radii grow or shrink by one common factor until
/// the coordination number is reached. What finds no place is put in smaller and grows.
void forced_filling(Packing&, const ForcedFilling& = {});

struct Relaxation {
  Real overlap = 1e-7;  ///< largest overlap / (R1 + R2) that may be left, walls included
  /// Each radius may change by this share beside the common factor, and by a fifth of the spread at most; it
  /// stays in the law's range. 0: all radii by one common factor only, which leaves the contacts of a jammed
  /// packing (Z near 6).
  Real radius_change = 0.05;
};
/// The contacts stay, their overlap goes: places and radii change a little until neighbours just touch.
void relaxation(Packing&, const Relaxation& = {});

}  // namespace beadwork::packing
