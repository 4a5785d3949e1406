// Where the files that a world names are looked for. URIs: model://NAME/REST, package://NAME/REST, file://PATH, a plain
// path, file://models/NAME/REST as model://NAME/REST too; https:// is never fetched.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tilth {

class ModelPath {
 public:
  /// In this order: `folders`, those of GAZEBO_MODEL_PATH, GAZEBO_RESOURCE_PATH, GZ_SIM_RESOURCE_PATH and
  /// IGN_GAZEBO_RESOURCE_PATH, the world's own folder, and models/ in it and beside it. Throws Error where one of
  /// `folders` is no folder.
  ModelPath(const std::filesystem::path& world_file, const std::vector<std::string>& folders);

  /// The file or folder; a plain path is tried `beside` the file that names it first, and in the folders above that
  /// last. Nothing where there is none.
  std::optional<std::filesystem::path> find(const std::string& uri, const std::filesystem::path& beside) const;

  std::string listing() const;  ///< the folders, for messages

 private:
  std::vector<std::filesystem::path> folders_;
};

}  // namespace tilth
