# What `cmake --install` puts where. The folder can be moved: nothing in it knows its own path. The executable and the
# plugin libraries install themselves (workbench/, plugins/).
include(CMakePackageConfigHelpers)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/Beadwork)

install(TARGETS beadwork EXPORT BeadworkTargets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY core DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/beadwork FILES_MATCHING PATTERN "*.hpp")
install(FILES ${PROJECT_BINARY_DIR}/generated/core/version.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/beadwork/core)
install(EXPORT BeadworkTargets NAMESPACE Beadwork:: DESTINATION ${package_folder})

configure_package_config_file(tools/cmake/BeadworkConfig.cmake.in ${PROJECT_BINARY_DIR}/BeadworkConfig.cmake
                              INSTALL_DESTINATION ${package_folder})
# Before version 1 nothing is promised from one minor version to the next.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/BeadworkConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/BeadworkConfig.cmake ${PROJECT_BINARY_DIR}/BeadworkConfigVersion.cmake
              tools/cmake/BeadworkPlugins.cmake DESTINATION ${package_folder})

install(FILES docs/reference/deck.md docs/reference/beadwork.xsd DESTINATION ${CMAKE_INSTALL_DATADIR}/beadwork)
# What one starts from: the template, and the plugins themselves.
install(DIRECTORY tools/plugin-template DESTINATION ${CMAKE_INSTALL_DATADIR}/beadwork/examples)
install(DIRECTORY plugins DESTINATION ${CMAKE_INSTALL_DATADIR}/beadwork/examples FILES_MATCHING PATTERN "*.cpp" PATTERN "*.hpp")
# Decks made by `beadwork new` name the schema, in the build folder too.
configure_file(docs/reference/beadwork.xsd ${PROJECT_BINARY_DIR}/share/beadwork/beadwork.xsd COPYONLY)
