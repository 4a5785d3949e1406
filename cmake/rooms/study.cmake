# JSON is written inside the room only.
find_package(nlohmann_json REQUIRED)
target_link_libraries(tilth_study PRIVATE nlohmann_json::nlohmann_json)
target_compile_options(tilth_study PRIVATE ${TILTH_QUICKLY_COMPILED})
