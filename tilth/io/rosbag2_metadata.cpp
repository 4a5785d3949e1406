#include <algorithm>
#include <string>

#include <yaml-cpp/yaml.h>

#include <tilth/core/error.hpp>
#include <tilth/io/file_kind.hpp>
#include <tilth/io/input_file.hpp>
#include <tilth/io/rosbag2_metadata.hpp>
#include <tilth/io/unpacked_file.hpp>

namespace tilth {
namespace {

namespace fs = std::filesystem;

/// Some recorders list the names that the files had before they were packed, some those after; either may lie there.
fs::path as_it_stands(const fs::path& listed) {
  const fs::path plain = unpacked_name(listed), packed = plain.string() + ".zstd";
  std::error_code error;  // of a name that no file can have
  for (const fs::path& path : {plain, packed}) {
    if (fs::exists(path, error)) return path;
  }
  return listed;
}

bool is_bag_file(const fs::path& path) {
  const std::string kind = kind_of_file(path);
  return !is_hidden(path) && (kind == ".db3" || kind == ".mcap");
}

std::vector<fs::path> listed_files(const fs::path& metadata) {
  std::vector<fs::path> files;
  const std::string text(as_text(read_file(metadata)));
  for (const std::string& file : parse_rosbag2_metadata(text, metadata.string()))
    files.push_back(as_it_stands(metadata.parent_path() / file));
  return files;
}

}  // namespace

std::vector<std::string> parse_rosbag2_metadata(const std::string& text, const std::string& name) {
  constexpr std::size_t kMostBytes = 1 << 21;  // in memory it takes some hundred times as much
  if (text.size() > kMostBytes) throw Error(name, "has more than " + std::to_string(kMostBytes) + " bytes");
  std::vector<std::string> files;
  try {
    const YAML::Node root = YAML::Load(text);
    if (!root.IsMap()) throw Error(name, "is no map of entries");
    const YAML::Node bag = root["rosbag2_bagfile_information"];
    const YAML::Node identifier = bag["storage_identifier"];  // some recorders leave it empty: names of files tell it
    const auto storage = !identifier || identifier.IsNull() ? std::string() : identifier.as<std::string>();
    if (!storage.empty() && storage != "sqlite3" && storage != "mcap")
      throw Error(name, "the bag is stored by " + storage + ", read are sqlite3 and mcap");
    for (const YAML::Node& file : bag["relative_file_paths"])
      files.push_back(fs::path(file.as<std::string>()).filename().string());
  } catch (const YAML::Exception& error) {
    throw Error(name, error.what());
  }
  return files;
}

std::vector<fs::path> rosbag2_files(const fs::path& folder) {
  std::vector<fs::path> files;
  if (fs::exists(folder / "metadata.yaml")) files = listed_files(folder / "metadata.yaml");
  if (files.empty()) {
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
      if (is_bag_file(entry.path())) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
  }
  if (files.empty()) throw Error(folder.string(), "lists no file of a ROS 2 bag");
  return files;
}

}  // namespace tilth
