# Decks as tests: what is said of bad ones, to the letter, and what good ones give.
set(here ${CMAKE_CURRENT_LIST_DIR})

function(beadwork_test_decks folder)
  file(GLOB expects CONFIGURE_DEPENDS ${here}/${folder}/*.expect)
  foreach(expect IN LISTS expects)
    get_filename_component(name ${expect} NAME_WE)
    add_test(NAME decks/${folder}/${name} COMMAND /usr/bin/python3 ${here}/run_${folder}.py $<TARGET_FILE:beadwork_cli> ${expect})
    set_tests_properties(decks/${folder}/${name} PROPERTIES LABELS decks TIMEOUT 300 SKIP_RETURN_CODE 77)
  endforeach()
endfunction()

beadwork_test_decks(bad)
beadwork_test_decks(good)
