# Highway is needed inside the room only.
target_link_libraries(tilth_preprocess PRIVATE hwy::hwy)
target_compile_definitions(tilth_preprocess PRIVATE ${TILTH_INSTRUCTION_SETS})
