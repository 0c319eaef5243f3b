#pragma once
// What a calibration is to find, and what it has found so far.

#include <array>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/mechanics/response.hpp"
#include "plugins/study/sample_decks.hpp"

namespace beadwork::calibration {

/// The solid that is wanted.
struct Material {
  std::string name;
  Real young, poisson;                    ///< [Pa], [1]
  std::optional<Real> strength, density;  ///< in tension [Pa]; [kg/m^3]
};

struct Plan {
  Material material;
  SampleDecks decks;
  std::vector<Real> ratios;  ///< at which the curves are measured
  std::int64_t seeds, first_seed;
  Real bond_poisson;
  bool through_centres;  ///< of the section that the force is taken over: it ends at the centres of the outer elements
  std::vector<std::string> criteria;  ///< "bbf-axial-bending", "rdef"
  std::set<std::string> tests;        ///< "compression", "bending", "torsion", "wave"
  bool all_are_tested;                ///< all samples, or the first alone
  std::int64_t rod_elements;          ///< of the rod that waves run along
  Real slenderness;                   ///< of it: how often it is as long as it is wide
};

/// A sample's packing.
struct Packed {
  std::int64_t seed;
  std::string file;   ///< from the folder of the decks
  Real coordination;  ///< of all elements
  Real coordination_bulk, density_bulk;
  Real fabric_low, fabric_high;  ///< eigenvalues
};

/// What one elastic run tells; moduli over the bonds' E_mu.
struct Elastic {
  Real poisson;
  Real centres, box;  ///< E from the reaction over the section to the outer centres, or over that of the box
  Real virial;        ///< E from stress and strain in the core
  Real sideways;      ///< lateral stress of the core over that along the axis: 0 if the sides are free
  Real carrying;      ///< force over the stress of the core: the section that carries [m^2]
};

/// By radius ratio, of one sample.
struct Curves {
  Response poisson, stiffness;
};

/// Of one criterion.
struct Strength {
  std::string criterion;
  std::vector<Real> wanted = {};     ///< by each sample, for the material's strength [Pa]
  Real value = 0;                    ///< of the parameter [Pa]
  std::vector<Real> confirmed = {};  ///< peaks with it [Pa]
  std::string trouble = {};          ///< why there is none
};

/// Young's modulus, or of torsion the shear modulus, by one test [Pa].
struct Modulus {
  Real section = std::numeric_limits<Real>::quiet_NaN();  ///< over that of the plan
  Real carrying =
      std::numeric_limits<Real>::quiet_NaN();  ///< over that which carries: the force over the core's stress
};

/// A rod that waves run along, and what one told.
struct Rod {
  Modulus still, wave;  ///< E by statics, and by the wave
  Real speed = std::numeric_limits<Real>::quiet_NaN();
  Real density = std::numeric_limits<Real>::quiet_NaN();  ///< mass over volume, where elements have 1000 kg/m^3
  Real bound = std::numeric_limits<Real>::quiet_NaN();    ///< share of its elements that bonds hold: the others stay
};

/// What the tests say of one sample.
struct Tested {
  std::int64_t seed;
  std::map<std::string, Modulus> moduli = {};  ///< by test
  Real poisson = std::numeric_limits<Real>::quiet_NaN();
  Real virial = std::numeric_limits<Real>::quiet_NaN();     ///< E from stress and strain in the core [Pa]
  Real from_ends = std::numeric_limits<Real>::quiet_NaN();  ///< E of bending by the turn of the ends [Pa]
  std::optional<Rod> rod = {};
};

/// What goes into the file of parameters.
struct Found {
  std::vector<Packed> packings;
  std::vector<Curves> curves;  ///< by sample
  Real ratio = 0;
  std::vector<Real> ratios;                           ///< of each sample by itself, where its curve reaches the target
  std::vector<Elastic> elastic;                       ///< of each sample at `ratio`, along the first axis
  std::map<std::string, std::vector<Elastic>> along;  ///< by axis
  Real young = 0;                                     ///< of the bonds [Pa]
  std::vector<std::array<Real, 2>> line;              ///< E of the bonds and of the first sample [Pa]
  std::vector<Tested> tested;
  std::vector<Strength> strengths;
};

}  // namespace beadwork::calibration
