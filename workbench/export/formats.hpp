#pragma once
// The formats that other programs read, each as the text of files.

#include <string>
#include <utility>
#include <vector>

#include "workbench/export/grid.hpp"

namespace beadwork::exported {

/// A file of the export: its name and what it holds.
struct File {
  std::string name, text;
};

/// The grids of a moment by their names, without their columns: what a series is made of.
struct Chapter {
  std::string moment;
  Real time = 0;  ///< [s]
  std::vector<std::string> grids;
};

/// Families of bonds and their fields (name and width), each once, as all moments of an export have them together.
struct Families {
  std::vector<std::string> names;
  std::vector<std::pair<std::string, int>> fields;
  void add(const Moment& moment);
};
/// Extended XYZ, as OVITO and ASE read it: elements-<step>.xyz; and the bonds as LAMMPS's "dump local",
/// bonds-<step>.dump, which OVITO lays over them (modifier "Load trajectory"). Families are numbered as `all` has them.
std::vector<File> as_xyz(const Moment& moment, const Families& all);
/// VTK's XML: elements-<step>.vtu, bonds-<family>-<step>.vtu, walls-<step>.vtu.
std::vector<File> as_vtu(const Moment& moment);
/// A .pvd for each grid, which ParaView follows through time.
std::vector<File> vtu_series(const std::vector<Chapter>& chapters);
/// Comma-separated: elements-<step>.csv, bonds-<family>-<step>.csv; names with units in the first line.
std::vector<File> as_csv(const Moment& moment);
/// breaks.csv.
std::vector<File> as_csv(const record::Breaks& breaks, const Lengths& lengths);

/// Names of the files of a moment's grids, without what follows the last point.
std::vector<std::string> grids_of(const Moment& moment);

}  // namespace beadwork::exported
