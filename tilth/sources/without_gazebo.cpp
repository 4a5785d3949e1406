#include <tilth/core/error.hpp>
#include <tilth/sources/world_scene.hpp>

namespace tilth {

Scene world_scene(const std::string& file, const std::string&, std::vector<std::string>&) {
  throw Error(file, "is a Gazebo world, which this build of Tilth cannot read (TILTH_WITH_GAZEBO is off)");
}

Mesh scene_mesh(const std::string& file) {
  throw Error(file, "is a mesh, which this build of Tilth cannot read (TILTH_WITH_GAZEBO is off)");
}

}  // namespace tilth
