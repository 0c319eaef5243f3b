#pragma once
// From where a specimen is looked at, and how much of it the picture holds.

#include "core/io/frame_reader.hpp"
#include "workbench/report/canvas.hpp"

namespace beadwork::report {

struct Box {
  Vec3 low, high;
  Vec3 size() const { return high - low; }
};

/// Where an element was before it moved, and where it is with its displacement times `factor`.
Vec3 at_rest(const record::Frame&, std::size_t element);
Vec3 magnified(const record::Frame&, std::size_t element, Real factor);

/// Around all elements that have a place; a unit box if none has.
Box box_at_rest(const record::Frame&);
Box box_magnified(const record::Frame&, Real factor);

/// The bonds that a picture is about, at rest: those of an interface, or else those that are no longer intact.
struct Weak {
  bool is_interface = false;
  Vec3 direction = Vec3::Zero();  ///< mean square of their directions along x, y, z; zero if there are none
  Vec3 scatter = Vec3::Zero();    ///< standard deviation of their places along x, y, z [m]
  std::size_t count = 0;
};
Weak weak_bonds(const record::Frame&, const std::vector<std::string>& interfaces);

/// Along which axes to look at the bodies, and at the bonds (-1: not at all).
struct Viewpoint {
  int bodies, bonds;
  std::string name;
};
/// A plane of weak bonds (an interface, a crack) is seen from its edge and from above. Around a fibre the bonds of the
/// interface have no direction along it: the picture looks down the fibre. Breaks that are few or spread over the
/// specimen say nothing: the broadest face is shown. `wanted` (x, y or z; may be empty) goes before all that.
Viewpoint choose_viewpoint(const Weak&, const Vec3& size, const std::string& wanted);

/// Looks along an axis: right is the longer of the two axes in the picture; z stands up wherever it is not right.
Camera camera_along(int axis, const Box&, Real margin);
/// "x to the right, z up"
std::string orientation(const Camera&);

}  // namespace beadwork::report
