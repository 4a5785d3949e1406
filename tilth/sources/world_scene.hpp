// A Gazebo world file as a scene, and the mesh of one that was simulated. A build without Gazebo's libraries refuses
// it: cmake/rooms/sources.cmake chooses between world_scene.cpp and without_gazebo.cpp.
#pragma once

#include <string>
#include <vector>

#include <tilth/simulation/scenes.hpp>

namespace tilth {

/// The scene of `file`, without a trajectory; `model_path` are the folders of models and meshes, with colons between.
/// Appends to `warnings` what was left out. Throws Error as read_world_file().
Scene world_scene(const std::string& file, const std::string& model_path, std::vector<std::string>& warnings);

/// All triangles of a mesh file, of one surface, as `scene/mesh.ply` of `tilth simulate`. Throws Error as
/// read_mesh_file().
Mesh scene_mesh(const std::string& file);

}  // namespace tilth
