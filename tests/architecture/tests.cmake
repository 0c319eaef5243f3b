# Tests of the house itself. They take the plugins that are built, so all of them must be.
set(here ${CMAKE_CURRENT_LIST_DIR})
find_program(XMLLINT xmllint)

function(architecture_test name)
  add_test(NAME architecture/${name} COMMAND ${ARGN})
  set_tests_properties(architecture/${name} PROPERTIES LABELS architecture TIMEOUT 900 ENVIRONMENT "BEADWORK_PLUGINS=")
endfunction()

architecture_test(include_directions /usr/bin/python3 ${here}/include_directions.py ${PROJECT_SOURCE_DIR})
architecture_test(one_definition /usr/bin/python3 ${here}/one_definition.py ${PROJECT_SOURCE_DIR})
architecture_test(docs_code_is_real /usr/bin/python3 ${here}/docs_code_is_real.py ${PROJECT_SOURCE_DIR})
architecture_test(docs_sessions /usr/bin/python3 ${here}/docs_sessions.py ${PROJECT_SOURCE_DIR} $<TARGET_FILE:beadwork_cli>)
architecture_test(describe /usr/bin/python3 ${here}/describe.py $<TARGET_FILE:beadwork_cli>)
architecture_test(skeletons /usr/bin/python3 ${here}/skeletons.py $<TARGET_FILE:beadwork_cli>)
architecture_test(batch bash ${here}/batch.sh ${PROJECT_SOURCE_DIR} $<TARGET_FILE:beadwork_cli>)
architecture_test(claims bash ${here}/claims.sh ${PROJECT_SOURCE_DIR} $<TARGET_FILE:beadwork_cli>)
architecture_test(plan bash ${here}/plan.sh ${PROJECT_SOURCE_DIR} $<TARGET_FILE:beadwork_cli>)
architecture_test(only_what_is_asked /usr/bin/python3 ${here}/only_what_is_asked.py ${PROJECT_SOURCE_DIR} $<TARGET_FILE:beadwork_cli>)
architecture_test(plugins_are_used /usr/bin/python3 ${here}/plugins_are_used.py ${PROJECT_SOURCE_DIR})
architecture_test(docs_up_to_date bash ${here}/docs_up_to_date.sh ${PROJECT_SOURCE_DIR} $<TARGET_FILE:beadwork_cli>)
if(XMLLINT)
  architecture_test(decks_validate bash ${here}/decks_validate.sh ${PROJECT_SOURCE_DIR} $<TARGET_FILE:beadwork_cli>)
endif()
# Plugins are built without the sanitizers that the installed core would want.
if(NOT BEADWORK_SANITIZE)
  architecture_test(installed_package bash ${here}/installed_package.sh ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR} ${CMAKE_CXX_COMPILER})
endif()

# Where valgrind is, which does not count what a sanitizer has built.
find_program(VALGRIND valgrind)
if(VALGRIND AND NOT BEADWORK_SANITIZE)
  architecture_test(unasked_costs_nothing bash ${here}/unasked_costs_nothing.sh $<TARGET_FILE:beadwork_cli>)
endif()
