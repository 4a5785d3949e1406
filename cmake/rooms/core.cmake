# Needed by the headers.
target_link_libraries(tilth_core PUBLIC Eigen3::Eigen TBB::tbb)
