#include <sstream>

#include <tilth/gazebo/world_file.hpp>
#include <tilth/sources/world_scene.hpp>

namespace tilth {
namespace {

std::vector<std::string> folders_of(const std::string& model_path) {
  std::vector<std::string> folders;
  std::istringstream words(model_path);
  for (std::string folder; std::getline(words, folder, ':');) {
    if (!folder.empty()) folders.push_back(folder);
  }
  return folders;
}

}  // namespace

Scene world_scene(const std::string& file, const std::string& model_path, std::vector<std::string>& warnings) {
  WorldFile world = read_world_file(file, folders_of(model_path));
  warnings.insert(warnings.end(), world.warnings.begin(), world.warnings.end());
  return {std::move(world.mesh), std::move(world.movers), {}};
}

}  // namespace tilth
