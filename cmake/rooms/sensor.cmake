# Files about a unit are YAML, XML or JSON: read inside the room only.
find_package(yaml-cpp REQUIRED)
find_package(pugixml REQUIRED)
find_package(nlohmann_json REQUIRED)
target_link_libraries(tilth_sensor PRIVATE yaml-cpp pugixml::pugixml nlohmann_json::nlohmann_json)
