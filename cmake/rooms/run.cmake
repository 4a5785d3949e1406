# JSON and OctoMaps are written inside the room only.
find_package(PkgConfig REQUIRED)
find_package(nlohmann_json REQUIRED)
pkg_check_modules(OCTOMAP REQUIRED IMPORTED_TARGET octomap)
target_link_libraries(tilth_run PRIVATE nlohmann_json::nlohmann_json PkgConfig::OCTOMAP)
set_source_files_properties(${PROJECT_SOURCE_DIR}/tilth/run/new_record.cpp PROPERTIES COMPILE_DEFINITIONS
                                                                                       TILTH_VERSION="${PROJECT_VERSION}")
