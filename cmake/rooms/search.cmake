# nanoflann and Highway are needed inside the room only.
target_link_libraries(tilth_search PRIVATE nanoflann::nanoflann hwy::hwy)
target_compile_definitions(tilth_search PRIVATE ${TILTH_INSTRUCTION_SETS})
