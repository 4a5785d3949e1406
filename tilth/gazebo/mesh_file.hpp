// Triangles of a mesh file, read with assimp (https://github.com/assimp/assimp): Collada, OBJ, STL, glTF and what else
// it knows. O(file).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <tilth/simulation/mesh.hpp>

namespace tilth {

/// One part of the file, where its nodes put it, in metres. Collada's unit counts, its up axis does not, as in Gazebo.
struct MeshPart {
  std::string node, name;  ///< either may be what <submesh> names
  Mesh mesh;               ///< without surfaces
};

/// Throws Error naming the file where it cannot be read or has no triangle.
std::vector<MeshPart> read_mesh_file(const std::filesystem::path& path);

}  // namespace tilth
