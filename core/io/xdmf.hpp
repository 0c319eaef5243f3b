#pragma once
// Describes recorded frames to ParaView: an XDMF file names, for each time, where in run.h5 the centres, the ends of
// the bonds and the fields lie.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/types.hpp"

namespace beadwork {

struct XdmfArray {
  std::string name;
  std::size_t rows = 0;
  std::size_t width = 1;
  bool integer = false;
  std::size_t bytes = 8;  ///< of one number
};

/// Points, or lines between two points each, with the arrays that lie on them.
struct XdmfGrid {
  std::string name;   ///< as the user picks it in the program
  std::string group;  ///< where the arrays lie
  std::vector<XdmfArray> arrays;
};

struct XdmfFrame {
  Real time = 0;                ///< [s]
  XdmfGrid elements;            ///< has an array "position"
  std::vector<XdmfGrid> bonds;  ///< each has an array "ends"
};

/// One grid at one time, as text.
struct XdmfPart {
  std::string grid;
  std::string text;
};

/// The parts of the file that stand for one frame; `file` is the HDF5 file beside it.
std::vector<XdmfPart> xdmf_parts(const XdmfFrame& frame, std::string_view file);
/// The whole file, from the parts of all frames in the order of time. Each grid is a series of its own, since ParaView
/// keeps the names of blocks only so: the user picks "elements" or "bonds resin" and follows it through time.
std::string xdmf_document(const std::vector<const XdmfPart*>& parts);

}  // namespace beadwork
