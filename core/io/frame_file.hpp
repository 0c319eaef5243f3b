#pragma once
// One frame as a group of an HDF5 file: written, and described to ParaView. Included by core/io only.

#include "core/io/h5.hpp"
#include "core/io/recorder.hpp"
#include "core/io/xdmf.hpp"

namespace beadwork {

void write_frame(hid_t group, const FrameStamp& stamp, const FrameRequest& request, const Domain& domain);

/// What the frame in `group` holds, its arrays standing under `place` in the file that the viewer opens.
XdmfFrame describe_frame(hid_t group, const std::string& place);

}  // namespace beadwork
