# Checksums are those of zlib, which is needed inside the room only.
find_package(ZLIB REQUIRED)
target_link_libraries(tilth_atlas PRIVATE ZLIB::ZLIB)
