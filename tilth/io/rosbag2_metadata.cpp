#include <algorithm>
#include <string>

#include <yaml-cpp/yaml.h>

#include <tilth/core/error.hpp>
#include <tilth/io/rosbag2_metadata.hpp>
#include <tilth/io/unpacked_file.hpp>

namespace tilth {
namespace {

namespace fs = std::filesystem;

/// Some recorders list the names that the files had before they were packed, some those after; either may lie there.
fs::path as_it_stands(const fs::path& listed) {
  const fs::path plain = unpacked_name(listed), packed = plain.string() + ".zstd";
  for (const fs::path& path : {plain, packed}) {
    if (fs::exists(path)) return path;
  }
  return listed;
}

bool is_bag_file(const fs::path& path) {
  const fs::path kind = unpacked_name(path).extension();
  return kind == ".db3" || kind == ".mcap";
}

std::vector<fs::path> listed_files(const fs::path& metadata) {
  std::vector<fs::path> files;
  try {
    const YAML::Node bag = YAML::LoadFile(metadata.string())["rosbag2_bagfile_information"];
    const auto storage = bag["storage_identifier"].as<std::string>("sqlite3");
    if (storage != "sqlite3" && storage != "mcap")
      throw Error(metadata.string(), "the bag is stored by " + storage + ", read are sqlite3 and mcap");
    for (const YAML::Node& file : bag["relative_file_paths"])
      files.push_back(as_it_stands(metadata.parent_path() / fs::path(file.as<std::string>()).filename()));
  } catch (const YAML::Exception& error) {
    throw Error(metadata.string(), error.what());
  }
  return files;
}

}  // namespace

std::vector<fs::path> rosbag2_files(const fs::path& folder) {
  std::vector<fs::path> files;
  if (fs::exists(folder / "metadata.yaml")) {
    files = listed_files(folder / "metadata.yaml");
  } else {
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
      if (is_bag_file(entry.path())) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
  }
  if (files.empty()) throw Error(folder.string(), "lists no file of a ROS 2 bag");
  return files;
}

}  // namespace tilth
