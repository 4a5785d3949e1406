// A Gazebo world or model (SDF 1.0 to 1.9 and later, http://sdformat.org/spec) as what a LiDAR meets, read with
// libsdformat. The visuals of a link count, as they do for Gazebo's GPU LiDAR; its collisions where it has no visual.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <tilth/simulation/mesh.hpp>
#include <tilth/simulation/movers.hpp>

namespace tilth {

struct WorldFile {
  Mesh mesh;                          ///< in the world frame; a surface's name is model/link/visual
  Movers movers;                      ///< actors, as people
  std::vector<std::string> warnings;  ///< what was left out, and why
};

/// Looks for models and meshes in `model_folders` and where ModelPath says. A model or mesh that is missing or broken
/// is left out with a warning that names its URI. Throws Error naming the file and the element where it is no SDF, and
/// where nothing is left that a beam could meet.
WorldFile read_world_file(const std::filesystem::path& path, const std::vector<std::string>& model_folders);

}  // namespace tilth
