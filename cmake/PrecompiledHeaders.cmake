# What nearly every file includes is compiled once for the rooms, once for the tests and once for the program: a third of
# the time of the build. Every file includes what it uses all the same; TILTH_PRECOMPILED_HEADERS=OFF shows what is missing.
# tilth_precompiled(<name> [LIBRARIES <target>...] [HEADERS <header>...])    beside those that all share
# tilth_use_precompiled(<target> <name>)    compiled with the same options
set(precompiled_headers
    <algorithm> <array> <bit> <charconv> <chrono> <cmath> <cstddef> <cstdint> <cstdio> <cstring> <deque> <filesystem>
    <fstream> <functional> <limits> <map> <memory> <numbers> <numeric> <optional> <set> <span> <sstream> <string>
    <string_view> <utility> <vector> <Eigen/Cholesky> <Eigen/Core> <Eigen/Eigenvalues> <Eigen/Geometry> <Eigen/LU>
    <tbb/parallel_for.h>)

function(tilth_precompiled name)
  if(NOT TILTH_PRECOMPILED_HEADERS)
    return()
  endif()
  cmake_parse_arguments(ARG "" "" "LIBRARIES;HEADERS" ${ARGN})
  set(target tilth_precompiled_${name})
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/precompiled/${name}.cpp CONTENT "")
  add_library(${target} OBJECT ${PROJECT_BINARY_DIR}/precompiled/${name}.cpp)
  target_compile_features(${target} PRIVATE cxx_std_20)
  target_link_libraries(${target} PRIVATE tilth_warnings Eigen3::Eigen TBB::tbb ${ARG_LIBRARIES})
  target_precompile_headers(${target} PRIVATE ${precompiled_headers} ${ARG_HEADERS})
endfunction()

function(tilth_use_precompiled target name)
  if(TARGET tilth_precompiled_${name})
    target_precompile_headers(${target} REUSE_FROM tilth_precompiled_${name})
  endif()
endfunction()
