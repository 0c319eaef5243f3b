# Small cases held in bands of their exact values.
foreach(case two-elements cantilever bar-wave notched-bar notched-bar-rdef tension dcb glued-block heap three-point-bending brazilian-disc
        indentation uniaxial-compression curved-beam roll-up notched-bar-static dcb-static alfano-crisfield enf calibration calibration-tests fibres single-fibre multi-fibre)
  add_test(NAME cases/${case} COMMAND /usr/bin/python3 ${CMAKE_CURRENT_LIST_DIR}/bands.py ${case} ${PROJECT_SOURCE_DIR} $<TARGET_FILE:beadwork_cli>)
  set_tests_properties(cases/${case} PROPERTIES LABELS cases TIMEOUT 300 ENVIRONMENT "BEADWORK_PLUGINS=")
endforeach()
