#include <algorithm>
#include <string>

#include <yaml-cpp/yaml.h>

#include <tilth/core/error.hpp>
#include <tilth/io/rosbag2_metadata.hpp>

namespace tilth {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> listed_files(const fs::path& metadata) {
  std::vector<fs::path> files;
  try {
    const YAML::Node bag = YAML::LoadFile(metadata.string())["rosbag2_bagfile_information"];
    const auto storage = bag["storage_identifier"].as<std::string>("sqlite3");
    if (storage != "sqlite3" && storage != "mcap")
      throw Error(metadata.string(), "the bag is stored by " + storage + ", read are sqlite3 and mcap");
    const auto mode = bag["compression_mode"].as<std::string>("");
    if (mode == "FILE" || mode == "file")
      throw Error(metadata.string(),
                  "the bag's files are compressed; uncompress them by `zstd -d` or `ros2 bag convert`");
    for (const YAML::Node& file : bag["relative_file_paths"])
      files.push_back(metadata.parent_path() / fs::path(file.as<std::string>()).filename());
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
      if (entry.path().extension() == ".db3" || entry.path().extension() == ".mcap") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
  }
  if (files.empty()) throw Error(folder.string(), "lists no file of a ROS 2 bag");
  return files;
}

}  // namespace tilth
