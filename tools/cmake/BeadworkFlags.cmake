# Flags that every target shares. Bits must not depend on how a compiler likes to fuse or reorder, so contraction
# is off and fast-math never on; errno and floating-point traps are not used anywhere.
set(BEADWORK_SANITIZE "" CACHE STRING "Sanitizers to build with, for -fsanitize=")

add_library(beadwork_flags INTERFACE)
target_compile_options(beadwork_flags INTERFACE
  -ffp-contract=off -fno-math-errno -fno-trapping-math -fno-semantic-interposition
  $<BUILD_INTERFACE:-Wall;-Wextra;-Wpedantic;-Wshadow;-Wno-unknown-pragmas;$<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>>)
target_compile_definitions(beadwork_flags INTERFACE EIGEN_DONT_VECTORIZE)  # as the core says to those that link it
if(BEADWORK_SANITIZE)
  target_compile_options(beadwork_flags INTERFACE -fsanitize=${BEADWORK_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(beadwork_flags INTERFACE -fsanitize=${BEADWORK_SANITIZE})
endif()
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Kind of build" FORCE)
endif()
