#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <tilth/core/error.hpp>
#include <tilth/gazebo/mesh_file.hpp>

namespace tilth {
namespace {

MeshPart part_of(const aiNode& node, const aiMesh& mesh, const aiMatrix4x4& to_file) {
  MeshPart part{node.mName.C_Str(), mesh.mName.C_Str(), {}};
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    const aiVector3D vertex = to_file * mesh.mVertices[i];
    part.mesh.vertices.emplace_back(vertex.x, vertex.y, vertex.z);
  }
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const aiFace& face = mesh.mFaces[i];
    if (face.mNumIndices != 3) continue;  // points and lines
    part.mesh.triangles.push_back({{face.mIndices[0], face.mIndices[1], face.mIndices[2]}, 0, kNoSides});
  }
  return part;
}

struct Placed {
  const aiNode* node;
  aiMatrix4x4 to_file;
};

std::vector<MeshPart> parts_of(const aiScene& scene) {
  std::vector<MeshPart> parts;
  std::vector<Placed> open{{scene.mRootNode, scene.mRootNode->mTransformation}};
  while (!open.empty()) {
    const Placed placed = open.back();
    open.pop_back();
    for (unsigned i = 0; i < placed.node->mNumMeshes; ++i) {
      MeshPart part = part_of(*placed.node, *scene.mMeshes[placed.node->mMeshes[i]], placed.to_file);
      if (!part.mesh.triangles.empty()) parts.push_back(std::move(part));
    }
    for (unsigned i = placed.node->mNumChildren; i-- > 0;) {
      const aiNode* child = placed.node->mChildren[i];
      open.push_back({child, placed.to_file * child->mTransformation});
    }
  }
  return parts;
}

}  // namespace

std::vector<MeshPart> read_mesh_file(const std::filesystem::path& path) {
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  const aiScene* scene = nullptr;
  try {
    scene = importer.ReadFile(path.string(), aiProcess_Triangulate | aiProcess_ValidateDataStructure);
  } catch (const std::exception& error) {
    throw Error(path.string(), std::string("is no mesh that can be read: ") + error.what());
  }
  if (!scene || !scene->mRootNode) {
    throw Error(path.string(), std::string("is no mesh that can be read: ") + importer.GetErrorString());
  }
  std::vector<MeshPart> parts = parts_of(*scene);
  if (parts.empty()) throw Error(path.string(), "has no triangle");
  return parts;
}

}  // namespace tilth
