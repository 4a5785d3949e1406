# Tests in Python, which hold our programs against other people's: tilth_python_test(<name> <script> <argument>...)
# The interpreter is that of the folder .venv, where scripts/ made one, else TILTH_PYTHON of the environment, else the
# system's. A script returns 77 where a package is missing: the test counts as skipped (where CI=true the script fails).
find_package(Python3 COMPONENTS Interpreter)

function(tilth_python_test name script)
  if(NOT BUILD_TESTING OR NOT Python3_Interpreter_FOUND)
    return()
  endif()
  set(command
      [[if [ -x "$0/.venv/bin/python" ]; then exec "$0/.venv/bin/python" "$@"; fi; exec "${TILTH_PYTHON:-$PYTHON3}" "$@"]])
  add_test(NAME ${name} COMMAND sh -c "${command}" ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/tests/${script} ${ARGN})
  set_tests_properties(
    ${name}
    PROPERTIES SKIP_RETURN_CODE 77
               COST 1000 # seconds, as ctest counts the others: these, the longest, begin first
               ENVIRONMENT "PYTHON3=${Python3_EXECUTABLE};OPENBLAS_NUM_THREADS=1")
endfunction()

if(BUILD_TESTING)
  add_executable(tilth_format_probe ${PROJECT_SOURCE_DIR}/tests/io/format_probe.cpp)
  tilth_link(tilth_format_probe io)
  tilth_python_test(io_point_files io/check_point_files.py $<TARGET_FILE:tilth_format_probe>)
  tilth_python_test(io_pcl io/check_pcl.py $<TARGET_FILE:tilth_app> $<TARGET_FILE:tilth_format_probe>)
  tilth_python_test(io_bags io/check_bags.py $<TARGET_FILE:tilth_format_probe>)
  tilth_python_test(io_mcap io/check_mcap.py $<TARGET_FILE:tilth_format_probe>)
  tilth_python_test(io_outputs io/check_outputs.py $<TARGET_FILE:tilth_app>)
  tilth_python_test(io_grid io/check_grid.py $<TARGET_FILE:tilth_app>)
  tilth_python_test(view_clients view/check_view.py $<TARGET_FILE:tilth_app>)
  tilth_python_test(io_rosbag2 io/check_rosbag2.py $<TARGET_FILE:tilth_format_probe> $<TARGET_FILE:tilth_app>)
  tilth_python_test(evaluation_evo evaluation/compare_with_evo.py $<TARGET_FILE:tilth_app>)
  tilth_python_test(evaluation_kitti evaluation/check_kitti.py $<TARGET_FILE:tilth_app>)
  tilth_python_test(apps_dask apps/check_dask.py $<TARGET_FILE:tilth_app>)
  tilth_python_test(apps_results apps/check_results.py $<TARGET_FILE:tilth_app>)
  tilth_python_test(apps_peers apps/check_peers.py $<TARGET_FILE:tilth_app>)
  tilth_python_test(apps_bench apps/check_bench.py $<TARGET_FILE:tilth_app>)
  tilth_python_test(documents_site documents/check_site.py)
  tilth_python_test(documents_pages documents/run_pages.py $<TARGET_FILE:tilth_app>)
  tilth_python_test(documents_command_lines documents/check_command_lines.py $<TARGET_FILE:tilth_app>)
  tilth_python_test(documents_completion documents/check_completion.py $<TARGET_FILE:tilth_app>)
  tilth_python_test(documents_translation documents/check_translation.py)
  if(NOT TILTH_SANITIZE) # neither ROS is built for it
    add_test(NAME ros2 COMMAND ${PROJECT_SOURCE_DIR}/scripts/test_ros2 jazzy ${PROJECT_BINARY_DIR})
    set_tests_properties(ros2 PROPERTIES SKIP_RETURN_CODE 77 COST 1000)
    add_test(NAME ros1 COMMAND ${PROJECT_SOURCE_DIR}/scripts/test_ros1 ${PROJECT_BINARY_DIR})
    set_tests_properties(ros1 PROPERTIES SKIP_RETURN_CODE 77 COST 1000 ENVIRONMENT TILTH_INSTALL=never)
  endif()
  if(TILTH_PYTHON)
    tilth_python_test(python_package python/check_package.py ${PROJECT_BINARY_DIR}/python)
  endif()
endif()
