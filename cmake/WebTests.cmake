# Tests of our pages in a browser: tilth_web_test(<name> <script> <argument>...). A script returns 77 where the browser or
# a library from npm is missing: the test counts as skipped (where CI=true the script fails).
function(tilth_web_test name script)
  set(command [[command -v node >/dev/null || { echo "SKIPPED: needs node"; [ "$CI" != true ] && exit 77; exit 1; }; exec node "$0" "$@"]])
  add_test(NAME ${name} COMMAND sh -c "${command}" ${PROJECT_SOURCE_DIR}/tests/web/${script} ${ARGN})
  set_tests_properties(${name} PROPERTIES SKIP_RETURN_CODE 77 COST 500)
endfunction()

if(BUILD_TESTING)
  add_executable(tilth_report_probe ${PROJECT_SOURCE_DIR}/tests/report/report_probe.cpp)
  tilth_link(tilth_report_probe report)
  tilth_web_test(web_run check_run.mjs $<TARGET_FILE:tilth_app>)
  tilth_web_test(web_hostile check_hostile.mjs $<TARGET_FILE:tilth_report_probe>)
  tilth_web_test(web_view check_view.mjs $<TARGET_FILE:tilth_app>)
  tilth_web_test(web_large check_large.mjs $<TARGET_FILE:tilth_report_probe>)
endif()
