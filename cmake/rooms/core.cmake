# The roots of many polynomials side by side: comparisons may raise no flags and square roots set no errno, else nothing
# becomes vectors.
set_source_files_properties(${PROJECT_SOURCE_DIR}/tilth/core/least_spread.cpp
                            PROPERTIES COMPILE_OPTIONS "-fno-trapping-math;-fno-math-errno")
