# Boost's Asio and Beast are needed inside the room only, JSON as well; both are headers.
find_package(Boost 1.74 REQUIRED)
find_package(Threads REQUIRED)
find_package(nlohmann_json REQUIRED)
target_link_libraries(tilth_view PRIVATE Boost::headers Threads::Threads nlohmann_json::nlohmann_json)
target_compile_options(tilth_view PRIVATE ${TILTH_QUICKLY_COMPILED})
