# JSON is written inside the room only.
find_package(nlohmann_json REQUIRED)
target_link_libraries(tilth_run PRIVATE nlohmann_json::nlohmann_json)
set_source_files_properties(${PROJECT_SOURCE_DIR}/tilth/run/new_record.cpp PROPERTIES COMPILE_DEFINITIONS
                                                                                       TILTH_VERSION="${PROJECT_VERSION}")
