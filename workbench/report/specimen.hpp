#pragma once
// How a specimen is looked at: which directions show it best, how much its displacements are magnified, what
// is coloured how. One stage serves all frames of a run, so that its pictures can be compared.

#include <map>
#include <string>
#include <vector>

#include "core/io/frame_reader.hpp"
#include "workbench/report/canvas.hpp"
#include "workbench/report/color_scale.hpp"
#include "workbench/report/viewpoint.hpp"

namespace beadwork::report {

/// Told apart by lightness as well as hue, so that they stay apart for colour-blind eyes and on grey paper.
namespace palette {
constexpr Color elastic = color(0x5B97D1), softening = color(0xF5A300), broken = color(0xB3123F);
constexpr Color body = color(0xC8CACC);
/// For named sets: greys, greens and violets, so that none is taken for the blue, amber and crimson of the states.
constexpr Color sets[] = {color(0xD3D3D3), color(0xA3AAA0), color(0xA9C8A4), color(0xC9B8DA),
                          color(0x7F8C80), color(0xD9DCC0), color(0x9A86B5), color(0x86B39B)};
constexpr Color wall = color(0x5C6B7A);
}  // namespace palette

enum class Show {
  bodies,  ///< the elements, deformed, tinted where their bonds soften or are broken
  bonds,   ///< the interface and every bond that is damaged, over a faint specimen that is not
           ///< deformed
};

struct View {
  Show show = Show::bodies;
  std::string name;  ///< "side view, x to the right, z up"
  Camera camera;
};

struct Legend {
  std::string label;
  Color color;
};

struct Stage {
  std::vector<View> views;
  Real magnification = 1;
  std::vector<std::string> interfaces;          ///< families that soften, and are few enough to be drawn whole
  std::map<std::int64_t, Color> element_color;  ///< by id; others have the colour of the body
  std::vector<Legend> sets;
};

struct Counts {
  std::size_t elastic = 0, softening = 0, broken = 0;
};

/// The stage for frames that show one specimen; `first` is its state of rest, `wanted` the axes to look along, "zy" (may
/// be empty).
Stage set_up(const record::Frame& first, const std::vector<record::Frame>& shown,
             const std::map<std::string, std::vector<std::int64_t>>& sets, const std::string& wanted);
/// The axes that the newest of these frames wants to be looked along, "zy"; empty if none says.
std::string wanted_view(const std::vector<record::Frame>& shown);

/// Bonds of the interfaces by state; of all families if there is no interface.
Counts counts(const Stage&, const record::Frame&);

/// The view's camera, less the height that this frame leaves empty: the scale stays that of the run.
Camera cropped(const Stage&, const View&, const record::Frame&);

Image draw(const Stage&, const View&, const record::Frame&, int width);
/// The same view with a recorded field in colours: of the elements, or of the bonds as segments over a faint specimen.
Image draw_field(const Stage&, const View&, const record::Frame&, const std::string& field, bool of_bonds,
                 const ColorScale&, int width);

/// Pixels for the view when the largest view of the stage is to fit into the given room: all have one scale.
int width_in_pixels(const Stage&, const View&, int widest, int tallest);

/// Takes what cannot be drawn out of a frame: elements whose place or size is no number, infinite or far outside of all
/// others lose both, and values of fields that are too large become no numbers. Returns how many elements.
std::size_t leave_out_odd(record::Frame&);

/// Where a frame records positions only: displacements from those of the same elements in the first frame.
void complete_displacement(record::Frame&, const record::Frame& first);

}  // namespace beadwork::report
