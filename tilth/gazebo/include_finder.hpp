// The models that a world includes: where they are, and whether they end. O(files) once each.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <tilth/gazebo/model_path.hpp>
#include <tilth/gazebo/warnings.hpp>

namespace tilth {

class IncludeFinder {
 public:
  IncludeFinder(const ModelPath& model_path, const std::filesystem::path& folder, Warnings& warnings)
      : model_path_(model_path), folder_(folder), warnings_(warnings) {}

  /// The file or folder of a model; empty, and said in a warning, where there is none and where the model includes
  /// itself. Gazebo's own ground plane and sun need no file. Throws Error after too many includes.
  std::string find(const std::string& uri);

  bool ground_plane() const { return ground_plane_; }  ///< asked for, and no file

 private:
  bool ends(const std::filesystem::path& model);
  const std::vector<std::filesystem::path>& included_by(const std::filesystem::path& model);

  const ModelPath& model_path_;
  std::filesystem::path folder_;
  Warnings& warnings_;
  std::size_t includes_ = 0;
  bool ground_plane_ = false;
  std::map<std::filesystem::path, std::vector<std::filesystem::path>> included_;
  std::map<std::filesystem::path, bool> ends_;
  std::set<std::filesystem::path> open_;  // models whose includes are being followed
};

}  // namespace tilth
