# Debian packages by CPack, of a build whose prefix is /usr (scripts/packages): the program, the libraries, what programs in C++
# need beside them, and the Python package. The simulator is part of the library io, which opens sim:// sources, so it is no
# package of its own.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME tilth)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/debian)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ
                                                WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL program libraries development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR})
set(TILTH_MAINTAINER "The Tilth authors" CACHE STRING "Who makes the packages: name <address>")
set(CPACK_DEBIAN_PACKAGE_MAINTAINER ${TILTH_MAINTAINER})
if(TARGET _tilth AND TILTH_PYTHON_DESTINATION)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()

set(soversion ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(libraries "libtilth${soversion} (= ${PROJECT_VERSION})")
string(CONCAT about "Tilth makes a trajectory and a map of the scans of one spinning\n"
       "LiDAR, and nothing else, and says how good they are.")

# debian_package(<component> <name> <section> <summary> <more> [<package it depends on>...])
function(debian_package component name section summary more)
  string(TOUPPER ${component} upper)
  list(JOIN ARGN ", " depends)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_DEPENDS ${depends} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_DESCRIPTION "${summary}\n${about}\n${more}" PARENT_SCOPE)
  set(documents ${CMAKE_INSTALL_DATADIR}/doc/${name})
  install(FILES ${told}/copyright ${told}/changelog.gz DESTINATION ${documents} COMPONENT ${component})
endfunction()

# What Debian wants to know of every package: who may copy it, and what has changed.
set(debian ${CMAKE_CURRENT_LIST_DIR}/debian)
set(told ${PROJECT_BINARY_DIR}/debian_documents)
file(READ ${PROJECT_SOURCE_DIR}/LICENSE license)
string(REGEX REPLACE "^.*\n\n(Permission)" "\\1" license "${license}")
string(STRIP "${license}" license)
string(REPLACE "\n\n" "\n.\n" license "${license}")
string(REPLACE "\n" "\n " license "${license}")
configure_file(${debian}/copyright.in ${told}/copyright @ONLY)
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
configure_file(${debian}/changelog.in ${told}/changelog @ONLY)
execute_process(COMMAND gzip -9nfk ${told}/changelog COMMAND_ERROR_IS_FATAL ANY)

debian_package(program tilth science "LiDAR-only SLAM: trajectory and map of a recording"
               "This is the program, with its simulator." python3)
debian_package(libraries libtilth${soversion} libs "LiDAR-only SLAM: shared libraries"
               "These are the libraries that programs in C++ and Python use.")
debian_package(development libtilth-dev libdevel "LiDAR-only SLAM: headers and CMake package"
               "This is what programs in C++ are built with." ${libraries} libeigen3-dev libtbb-dev)
if(python IN_LIST CPACK_COMPONENTS_ALL)
  debian_package(python python3-tilth python "LiDAR-only SLAM: Python package" "This is the Python package, on numpy arrays."
                 ${libraries} "tilth (= ${PROJECT_VERSION})" python3-numpy ${python_versions})
endif()

# Who is linked with a library needs this package.
set(shlibs "")
foreach(component IN LISTS components)
  string(APPEND shlibs "libtilth_${component} ${soversion} libtilth${soversion} (>= ${PROJECT_VERSION})\n")
endforeach()
file(CONFIGURE OUTPUT ${told}/shlibs CONTENT "${shlibs}")
set(CPACK_DEBIAN_LIBRARIES_PACKAGE_CONTROL_EXTRA ${told}/shlibs ${debian}/libraries/triggers)
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${debian}/python/postinst ${debian}/python/prerm)
include(CPack)
