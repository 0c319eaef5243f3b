# Each case's quick deck: same bits on one and two threads and across a restart, and nothing lost by a kill.
set(here ${CMAKE_CURRENT_LIST_DIR})
file(GLOB decks CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/xml-cases/*/quick.xml)
foreach(deck IN LISTS decks)
  get_filename_component(folder ${deck} DIRECTORY)
  get_filename_component(name ${folder} NAME)
  set(questions same_bits killed terminated resolved)
  if(name MATCHES "cantilever|notched-bar")
    list(APPEND questions mixed)
  endif()
  foreach(question IN LISTS questions)
    add_test(NAME cases/${name}/${question} COMMAND /usr/bin/python3 ${here}/run_cases.py $<TARGET_FILE:beadwork_cli> ${deck} ${question})
    set_tests_properties(cases/${name}/${question} PROPERTIES LABELS cases TIMEOUT 600 ENVIRONMENT "BEADWORK_PLUGINS=")
  endforeach()
endforeach()

# Killed at random, again and again. More rounds than here: kills.py BEADWORK DECK 80
foreach(deck breaks stages)
  add_test(NAME cases/kills/${deck} COMMAND /usr/bin/python3 ${here}/kills/kills.py $<TARGET_FILE:beadwork_cli> ${here}/kills/${deck}.xml 6)
  set_tests_properties(cases/kills/${deck} PROPERTIES LABELS cases TIMEOUT 600 ENVIRONMENT "BEADWORK_PLUGINS=")
endforeach()

# What a run leaves opens in ParaView itself, where that is installed.
find_program(PVPYTHON pvpython)
if(PVPYTHON)
  add_test(NAME cases/opens_in_paraview COMMAND bash ${here}/opens_in_paraview.sh ${PROJECT_SOURCE_DIR} $<TARGET_FILE:beadwork_cli>)
  set_tests_properties(cases/opens_in_paraview PROPERTIES LABELS cases TIMEOUT 600 ENVIRONMENT "BEADWORK_PLUGINS=")
endif()
