# The installed libraries: tilth::<component> is the rooms under its heading in rooms.txt, with the libraries that they need
# inside. Of the headers, those of public_headers.txt are installed.
# tilth_component(<name> [COMPONENTS <component>...] [LIBRARIES <target>...])    LIBRARIES are needed by the headers
include(CMakePackageConfigHelpers)

function(tilth_component name)
  cmake_parse_arguments(ARG "" "" "COMPONENTS;LIBRARIES" ${ARGN})
  if(NOT name IN_LIST components)
    return()
  endif()
  set(target tilth_component_${name})
  add_library(${target} SHARED)
  add_library(tilth::${name} ALIAS ${target})
  foreach(room IN LISTS ${name}_ROOMS)
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:tilth_${room}>)
    get_target_property(libraries tilth_${room} LINK_LIBRARIES)
    list(FILTER libraries EXCLUDE REGEX "^tilth_")
    list(REMOVE_ITEM libraries ${ARG_LIBRARIES})
    target_link_libraries(${target} PRIVATE ${libraries})
  endforeach()
  foreach(below IN LISTS ARG_COMPONENTS)
    if(below IN_LIST components)
      target_link_libraries(${target} PUBLIC tilth::${below})
    endif()
  endforeach()
  target_link_libraries(${target} PUBLIC ${ARG_LIBRARIES})
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target} INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                                 $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  set_target_properties(
    ${target}
    PROPERTIES OUTPUT_NAME tilth_${name}
               EXPORT_NAME ${name}
               INSTALL_RPATH "$ORIGIN"
               LINKER_LANGUAGE CXX)
  if(NOT SKBUILD) # a wheel has no symbolic links
    set_target_properties(${target} PROPERTIES VERSION ${PROJECT_VERSION}
                                               SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  endif()
  install(TARGETS ${target} EXPORT tilth
          LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT libraries NAMELINK_COMPONENT development)
endfunction()

tilth_component(odometry LIBRARIES Eigen3::Eigen TBB::tbb)
tilth_component(slam COMPONENTS odometry)
tilth_component(simulation COMPONENTS odometry)
tilth_component(gazebo COMPONENTS simulation)
tilth_component(io COMPONENTS odometry simulation gazebo)
tilth_component(run COMPONENTS odometry slam io)

# "tilth.hpp" stands above the rooms.
set(public_headers ${PROJECT_SOURCE_DIR}/cmake/public_headers.txt)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${public_headers})
file(STRINGS ${public_headers} public_headers REGEX "^[a-z]")
foreach(header IN LISTS public_headers)
  get_filename_component(room ${header} DIRECTORY)
  if(room STREQUAL "" OR room IN_LIST rooms)
    install(FILES ${PROJECT_SOURCE_DIR}/tilth/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/tilth/${room}
            COMPONENT development)
  endif()
endforeach()

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/tilth)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/tilthConfig.cmake.in ${PROJECT_BINARY_DIR}/tilthConfig.cmake
                              INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/tilthConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/tilthConfig.cmake ${PROJECT_BINARY_DIR}/tilthConfigVersion.cmake
        DESTINATION ${package_folder} COMPONENT development)
install(EXPORT tilth NAMESPACE tilth:: FILE tilthTargets.cmake DESTINATION ${package_folder} COMPONENT development)
export(EXPORT tilth NAMESPACE tilth:: FILE ${PROJECT_BINARY_DIR}/tilthTargets.cmake) # -Dtilth_DIR=<build folder>
