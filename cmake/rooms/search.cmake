# nanoflann and Highway are needed inside the room only. Of x86's instruction sets the baseline, AVX2 and AVX-512 are
# compiled; those between them gain nothing here.
target_link_libraries(tilth_search PRIVATE nanoflann::nanoflann hwy::hwy)
target_compile_definitions(tilth_search PRIVATE "HWY_DISABLED_TARGETS=(HWY_SSSE3|HWY_SSE4|HWY_AVX3_DL)")
