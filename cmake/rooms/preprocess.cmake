# Highway is needed inside the room only.
target_link_libraries(tilth_preprocess PRIVATE hwy::hwy)
