# The installed libraries: rooms gathered into few, each with the libraries its rooms need inside.
# tilth_package(<name> [ROOMS <room>...] [LIBRARIES <target>...])     LIBRARIES are needed by the headers
#
# find_package(tilth) then offers tilth::tilth (Eigen and TBB, nothing else), tilth::simulation, tilth::slam, tilth::io, tilth::run.
include(CMakePackageConfigHelpers)

function(tilth_package name)
  cmake_parse_arguments(ARG "" "" "ROOMS;LIBRARIES" ${ARGN})
  set(target tilth_package_${name})
  add_library(${target} SHARED)
  add_library(tilth::${name} ALIAS ${target})
  foreach(room IN LISTS ARG_ROOMS)
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:tilth_${room}>)
    get_target_property(libraries tilth_${room} LINK_LIBRARIES)
    list(FILTER libraries EXCLUDE REGEX "^tilth_")
    list(REMOVE_ITEM libraries ${ARG_LIBRARIES})
    target_link_libraries(${target} PRIVATE ${libraries})
  endforeach()
  target_link_libraries(${target} PUBLIC ${ARG_LIBRARIES})
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target} INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                                 $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  string(REPLACE "tilth_tilth" "tilth" output tilth_${name})
  set_target_properties(
    ${target}
    PROPERTIES OUTPUT_NAME ${output}
               EXPORT_NAME ${name}
               VERSION ${PROJECT_VERSION}
               SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
               INSTALL_RPATH "$ORIGIN"
               LINKER_LANGUAGE CXX)
  install(TARGETS ${target} EXPORT tilth LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
endfunction()

tilth_package(tilth ROOMS core search sensor evaluation preprocess features registration map odometry LIBRARIES
              Eigen3::Eigen TBB::tbb)
tilth_package(simulation ROOMS simulation LIBRARIES tilth::tilth)
tilth_package(io ROOMS io messages gazebo sources LIBRARIES tilth::tilth tilth::simulation)
tilth_package(slam ROOMS slam LIBRARIES tilth::tilth)
tilth_package(run ROOMS plot run report study LIBRARIES tilth::tilth tilth::io tilth::slam)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/tilth)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/tilthConfig.cmake.in ${PROJECT_BINARY_DIR}/tilthConfig.cmake
                              INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/tilthConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/tilthConfig.cmake ${PROJECT_BINARY_DIR}/tilthConfigVersion.cmake
        DESTINATION ${package_folder})
install(EXPORT tilth NAMESPACE tilth:: FILE tilthTargets.cmake DESTINATION ${package_folder})
install(
  DIRECTORY ${PROJECT_SOURCE_DIR}/tilth
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  FILES_MATCHING
  PATTERN "*.hpp")
