# Highway is needed inside the room only.
target_link_libraries(tilth_features PRIVATE hwy::hwy)
