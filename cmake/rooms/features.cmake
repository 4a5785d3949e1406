# Highway is needed inside the room only.
target_link_libraries(tilth_features PRIVATE hwy::hwy)
# Square roots of negative numbers set no errno, and comparisons no flags, that anybody reads: loops with them vectorise.
target_compile_options(tilth_features PRIVATE -fno-math-errno -fno-trapping-math)
