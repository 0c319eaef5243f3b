#pragma once
// Triangles of an STL file, binary or of text.

#include <filesystem>
#include <string>
#include <vector>

#include "core/domain/surface.hpp"

namespace beadwork {

/// In the file's own unit of length, in its order; its normals are not read, since the corners tell them. Throws
/// DeckFailure with `file:line:column` of a text, or the number of the triangle, for what is no STL.
std::vector<Triangle> read_stl(const std::filesystem::path& file);
/// The same from what stands in it; `name` is told in errors.
std::vector<Triangle> parse_stl(const std::string& bytes, const std::string& name);

}  // namespace beadwork
