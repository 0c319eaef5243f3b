# beadwork_add_plugins(library [NAMESPACE name] [VECTORISED] source...): one shared library of plugins, one plugin per
# source file.
#
# The list that the library hands over is generated from the file names (cohesive_beam.cpp holds class CohesiveBeam in
# namespace beadwork or in the one named by NAMESPACE), so a new plugin is one new file and no list is edited. Each source
# is compiled through a small generated file that includes it. Works in the tree and from the installed package.
#
# VECTORISED compiles it once more for each wider instruction set, into folders avx2/ and avx512/ beside it; the program
# opens the widest one that the processor has. Each is a library of its own, so that no function compiled for one
# processor can be linked into what runs on another. BEADWORK_VARIANTS_<library> lists those targets.

# What -march=... would allow beyond these is left out: the program asks the processor for exactly these.
set(BEADWORK_INSTRUCTIONS_avx2 -mavx2)
set(BEADWORK_INSTRUCTIONS_avx512 -mavx512f -mavx512dq -mavx512vl)

function(beadwork_add_plugins library)
  cmake_parse_arguments(PLUGINS "VECTORISED" "NAMESPACE" "" ${ARGN})
  if(NOT PLUGINS_NAMESPACE)
    set(PLUGINS_NAMESPACE beadwork)
  endif()
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/${library}_plugins)
  set(declarations "")
  set(entries "")
  set(wrappers "")
  foreach(source IN LISTS PLUGINS_UNPARSED_ARGUMENTS)
    get_filename_component(path ${source} ABSOLUTE)
    get_filename_component(stem ${source} NAME_WE)
    string(REPLACE "_" "-" tag ${stem})
    string(REPLACE "_" ";" words ${stem})
    set(class "")
    foreach(word IN LISTS words)
      string(SUBSTRING ${word} 0 1 head)
      string(SUBSTRING ${word} 1 -1 tail)
      string(TOUPPER ${head} head)
      string(APPEND class ${head}${tail})
    endforeach()
    file(CONFIGURE OUTPUT ${folder}/${stem}.cpp @ONLY CONTENT "#include \"@path@\"
beadwork::PluginEntry beadwork_entry_@stem@();
beadwork::PluginEntry beadwork_entry_@stem@() { return beadwork::entry<@PLUGINS_NAMESPACE@::@class@>(\"@tag@\"); }
")
    list(APPEND wrappers ${folder}/${stem}.cpp)
    string(APPEND declarations "beadwork::PluginEntry beadwork_entry_${stem}();\n")
    string(APPEND entries "      beadwork_entry_${stem}(),\n")
  endforeach()
  file(CONFIGURE OUTPUT ${folder}/list.cpp @ONLY CONTENT "#include \"core/plugin/library.hpp\"
#include \"core/plugin/stamp.hpp\"
@declarations@
extern \"C\" __attribute__((visibility(\"default\"))) const char* beadwork_stamp();
extern \"C\" const char* beadwork_stamp() {
  static const std::string stamp = beadwork::compiled_stamp();
  return stamp.c_str();
}
extern \"C\" __attribute__((visibility(\"default\"))) const std::vector<beadwork::PluginEntry>* beadwork_plugins();
extern \"C\" const std::vector<beadwork::PluginEntry>* beadwork_plugins() {
  static const std::vector<beadwork::PluginEntry> list{
@entries@  };
  return &list;
}
")
  set(variants "")
  if(PLUGINS_VECTORISED AND CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    set(variants avx2 avx512)
  endif()
  foreach(variant IN ITEMS "" LISTS variants)
    set(target ${library})
    if(variant)
      set(target ${library}_${variant})
    endif()
    add_library(${target} MODULE ${wrappers} ${folder}/list.cpp)
    set_target_properties(${target} PROPERTIES PREFIX "" OUTPUT_NAME ${library} CXX_VISIBILITY_PRESET hidden
                          VISIBILITY_INLINES_HIDDEN ON)
    target_link_libraries(${target} PRIVATE Beadwork::beadwork)
    if(variant)
      target_compile_options(${target} PRIVATE ${BEADWORK_INSTRUCTIONS_${variant}})
      set_target_properties(${target} PROPERTIES INSTALL_RPATH "$ORIGIN/../.."
                            LIBRARY_OUTPUT_DIRECTORY $<TARGET_FILE_DIR:${library}>/${variant})
    else()
      set_target_properties(${target} PROPERTIES INSTALL_RPATH "$ORIGIN/..")
    endif()
  endforeach()
  foreach(variant avx2 avx512)
    if(NOT variant IN_LIST variants)  # one of an earlier build would be opened before this library
      add_custom_command(TARGET ${library} POST_BUILD
                         COMMAND ${CMAKE_COMMAND} -E rm -f $<TARGET_FILE_DIR:${library}>/${variant}/$<TARGET_FILE_NAME:${library}>)
    endif()
  endforeach()
  set(BEADWORK_VARIANTS_${library} ${variants} PARENT_SCOPE)
endfunction()
