#pragma once
// What follows from a deck before it runs.

#include <string>

#include "core/loop/scene.hpp"

namespace beadwork {

/// Phases, fields, columns with their bytes, and what is not needed: all that is known without filling.
std::string plan_text(const Scene& scene);

/// Bytes of one row of a table, with what its alignment costs.
std::size_t row_bytes(const Table& table, On on);

}  // namespace beadwork
