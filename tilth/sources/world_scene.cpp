#include <sstream>

#include <tilth/gazebo/mesh_file.hpp>
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

Mesh scene_mesh(const std::string& file) {
  Mesh whole;
  add_surface(whole, {"mesh"});
  for (const MeshPart& part : read_mesh_file(file)) {
    const auto first = std::uint32_t(whole.vertices.size());
    whole.vertices.insert(whole.vertices.end(), part.mesh.vertices.begin(), part.mesh.vertices.end());
    for (Triangle triangle : part.mesh.triangles) {
      for (std::uint32_t& vertex : triangle.vertices) vertex += first;
      whole.triangles.push_back(triangle);
    }
  }
  return whole;
}

}  // namespace tilth
