# Damaged runs, read by what the program reads them with, compiled once more with the sanitizers of addresses and undefined behaviour.
file(GLOB damaged_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/core/io/*.cpp ${PROJECT_SOURCE_DIR}/core/domain/*.cpp ${PROJECT_SOURCE_DIR}/workbench/report/*.cpp)
add_executable(test_damaged ${CMAKE_CURRENT_LIST_DIR}/damaged.cpp ${damaged_sources})
target_include_directories(test_damaged PRIVATE ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR}/generated)
target_compile_options(test_damaged PRIVATE -O1 -g1 -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
target_link_options(test_damaged PRIVATE -fsanitize=address,undefined)
target_link_libraries(test_damaged PRIVATE beadwork beadwork_flags hdf5::hdf5 PNG::PNG nlohmann_json::nlohmann_json)
add_test(NAME damaged/runs COMMAND /usr/bin/python3 ${CMAKE_CURRENT_LIST_DIR}/corpus.py $<TARGET_FILE:test_damaged>)
set_tests_properties(damaged/runs PROPERTIES LABELS damaged TIMEOUT 600)
