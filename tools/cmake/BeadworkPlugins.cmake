# beadwork_add_plugins(library source...): one shared library of plugins, one plugin per source file.
#
# The list that the library hands over is generated from the file names (cohesive_beam.cpp holds class CohesiveBeam in
# namespace beadwork or in the one named by NAMESPACE), so a new plugin is one new file and no list is edited. Each source
# is compiled through a small generated file that includes it. Works in the tree and from the installed package.
function(beadwork_add_plugins library)
  cmake_parse_arguments(PLUGINS "" "NAMESPACE" "" ${ARGN})
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
  add_library(${library} MODULE ${wrappers} ${folder}/list.cpp)
  set_target_properties(${library} PROPERTIES PREFIX "" CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON
                        INSTALL_RPATH "$ORIGIN/..")
  target_link_libraries(${library} PRIVATE Beadwork::beadwork)
endfunction()
