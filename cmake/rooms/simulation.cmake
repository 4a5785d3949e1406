# Embree is needed inside the room only.
target_link_libraries(tilth_simulation PRIVATE embree)
