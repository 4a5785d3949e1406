# Needed by the headers.
target_link_libraries(tilth_core PUBLIC Eigen3::Eigen TBB::tbb)
# Square roots of negative numbers set no errno that anybody reads.
set_source_files_properties(${PROJECT_SOURCE_DIR}/tilth/core/symmetric_eigen.cpp PROPERTIES COMPILE_OPTIONS
                                                                                         "-fno-math-errno")
