# Ceres is needed inside the room only.
find_package(Ceres REQUIRED)
target_link_libraries(tilth_slam PRIVATE Ceres::ceres)
