#pragma once
// The specimen as one can turn it: its frames, for a browser that draws in three dimensions.

#include <string>
#include <vector>

#include "workbench/report/run.hpp"
#include "workbench/report/specimen.hpp"

namespace beadwork::report {

/// A section with the frames' elements, the bonds that are of an interface or no longer intact, the recorded fields of the
/// first frame, and the program that draws them (three.js, which stands in the page). Of many frames some are left out, so
/// that elements take some ten megabytes or what the last frame alone takes. A note in the run, and nothing else, where three.js is not installed.
std::string turnable(Run&, const Stage&, const std::vector<record::Frame>& frames);

}  // namespace beadwork::report
