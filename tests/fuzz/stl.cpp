#include <cmath>
#include <cstdlib>

#include "core/io/stl.hpp"
#include "tests/fuzz/input.hpp"

using namespace beadwork;

// What is taken has finite corners.
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  return fuzz::refused_or_read([&] {
    for (const Triangle& triangle : parse_stl(bytes, "wall.stl"))
      for (const Vec3& corner : triangle)
        if (!corner.allFinite()) std::abort();
  });
}
