# JSON is written inside the room only.
target_link_libraries(tilth_study PRIVATE nlohmann_json::nlohmann_json)
