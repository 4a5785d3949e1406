// The geometry of an SDF visual or collision as triangles.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <sdf/Geometry.hh>

#include <tilth/gazebo/mesh_file.hpp>
#include <tilth/gazebo/model_path.hpp>
#include <tilth/gazebo/warnings.hpp>

namespace tilth {

/// Where a shape stands.
struct Place {
  std::string name;    ///< model/link/visual
  Pose T_world_shape;  ///< its own frame
  SurfaceId surface = 0;
};

/// Reads each mesh file once.
class ShapeReader {
 public:
  ShapeReader(const ModelPath& model_path, Warnings& warnings) : model_path_(model_path), warnings_(warnings) {}

  /// Adds the shape, its edges marked; says in a warning why where it is left out.
  void add(Mesh& mesh, const Place& place, const sdf::Geometry& geometry);

 private:
  void add_shape(Mesh& mesh, const Place& place, const sdf::Geometry& geometry);
  void add_mesh(Mesh& mesh, const Place& place, const sdf::Mesh& shape);
  const std::vector<MeshPart>* parts_of(const sdf::Mesh& shape, const std::string& name);

  const ModelPath& model_path_;
  Warnings& warnings_;
  std::map<std::string, std::vector<MeshPart>> files_;  // by path; empty: cannot be read
};

}  // namespace tilth
