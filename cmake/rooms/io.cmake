# The formats' own libraries are needed inside the room only.
find_package(PkgConfig REQUIRED)
find_package(yaml-cpp REQUIRED)
pkg_check_modules(LZ4 REQUIRED IMPORTED_TARGET liblz4)
pkg_check_modules(PCAP REQUIRED IMPORTED_TARGET libpcap)
pkg_check_modules(SQLITE REQUIRED IMPORTED_TARGET sqlite3)
pkg_check_modules(ZSTD REQUIRED IMPORTED_TARGET libzstd)
find_package(BZip2 REQUIRED)
find_path(TILTH_LZF_INCLUDE liblzf/lzf.h REQUIRED)
find_library(TILTH_LZF lzf REQUIRED)
target_link_libraries(tilth_io PRIVATE PkgConfig::LZ4 PkgConfig::ZSTD PkgConfig::PCAP PkgConfig::SQLITE BZip2::BZip2 yaml-cpp
                                       ${TILTH_LZF})
target_include_directories(tilth_io SYSTEM PRIVATE ${TILTH_LZF_INCLUDE})
