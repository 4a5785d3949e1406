# Embree is needed inside the room only: 3 in Debian 12, 4 in Ubuntu 24.04.
find_package(embree 4 QUIET)
if(NOT embree_FOUND)
  find_package(embree 3 REQUIRED)
endif()
target_link_libraries(tilth_simulation PRIVATE embree)
