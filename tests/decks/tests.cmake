# Decks as tests: what is said of bad ones, to the letter, what good ones give, and what comes of several commands on one.
set(here ${CMAKE_CURRENT_LIST_DIR})

function(beadwork_test_decks folder script label seconds)
  file(GLOB expects CONFIGURE_DEPENDS ${here}/${folder}/*.expect)
  foreach(expect IN LISTS expects)
    get_filename_component(name ${expect} NAME_WE)
    add_test(NAME decks/${folder}/${name} COMMAND /usr/bin/python3 ${here}/${script} $<TARGET_FILE:beadwork_cli> ${expect})
    set_tests_properties(decks/${folder}/${name} PROPERTIES LABELS ${label} TIMEOUT ${seconds} SKIP_RETURN_CODE 77)
  endforeach()
endfunction()

beadwork_test_decks(bad run_session.py decks 300)
beadwork_test_decks(sessions run_session.py decks 300)
beadwork_test_decks(good run_good.py decks 300)
beadwork_test_decks(nightly run_session.py nightly 1800)  # longer than a test may be: left out of what tools/test.sh runs
