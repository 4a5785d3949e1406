# Embree is needed inside the room only.
find_package(embree 3 REQUIRED)
target_link_libraries(tilth_simulation PRIVATE embree)
