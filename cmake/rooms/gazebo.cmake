# libsdformat goes by its version: 12 in Debian 12, 14 in Ubuntu 24.04. Both libraries are needed inside the room only.
find_package(PkgConfig REQUIRED)
foreach(version 15 14 13 12)
  pkg_check_modules(SDFORMAT QUIET IMPORTED_TARGET sdformat${version})
  if(SDFORMAT_FOUND)
    break()
  endif()
endforeach()
if(NOT SDFORMAT_FOUND)
  message(FATAL_ERROR "libsdformat is missing: install libsdformat-dev (Ubuntu 24.04: libsdformat14-dev)")
endif()
set_target_properties(PkgConfig::SDFORMAT PROPERTIES INTERFACE_COMPILE_OPTIONS "") # it asks for C++17
pkg_check_modules(ASSIMP REQUIRED IMPORTED_TARGET assimp)
target_link_libraries(tilth_gazebo PRIVATE PkgConfig::SDFORMAT PkgConfig::ASSIMP)
