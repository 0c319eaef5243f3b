#pragma once
// What a plugin library and the program must agree on, since they share C++ types. Compiled into both.

#include <fmt/format.h>

#include <string>

#include "core/base/types.hpp"
#include "core/version.hpp"

namespace beadwork {

inline std::string compiled_stamp() {
#if defined(__clang__)
  const std::string compiler = fmt::format("clang {}", __clang_major__);
#else
  const std::string compiler = fmt::format("gcc {}", __GNUC__);
#endif
  return fmt::format("beadwork {}, real {} bytes, Eigen {}.{}.{} aligned to {}, {}, libstdc++ {}", version,
                     sizeof(Real), EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION,
                     EIGEN_MAX_STATIC_ALIGN_BYTES, compiler, __GLIBCXX__);
}

}  // namespace beadwork
