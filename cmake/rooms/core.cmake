# Square roots of negative numbers set no errno that anybody reads.
set_source_files_properties(${PROJECT_SOURCE_DIR}/tilth/core/least_spread.cpp PROPERTIES COMPILE_OPTIONS
                                                                                         "-fno-math-errno")
