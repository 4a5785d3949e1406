# Highway is needed inside the room only.
target_link_libraries(tilth_features PRIVATE hwy::hwy)
target_compile_definitions(tilth_features PRIVATE ${TILTH_INSTRUCTION_SETS})
