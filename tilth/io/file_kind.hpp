// What the name of a file tells of its kind.
#pragma once

#include <filesystem>
#include <string>

namespace tilth {

/// The extension in lower case, without what says that the file is packed (.zstd, .zst) or was never closed (.active):
/// ".bag" of "a.BAG" and "a.bag.active", ".db3" of "b.db3.zstd".
std::string kind_of_file(const std::filesystem::path& path);

/// The name begins with a point: what systems put beside files, as macOS "._scan.pcd" on foreign disks.
bool is_hidden(const std::filesystem::path& path);

}  // namespace tilth
