#include <algorithm>
#include <filesystem>

#include <sdf/Box.hh>
#include <sdf/Capsule.hh>
#include <sdf/Cylinder.hh>
#include <sdf/Element.hh>
#include <sdf/Ellipsoid.hh>
#include <sdf/Mesh.hh>
#include <sdf/Plane.hh>
#include <sdf/Sphere.hh>

#include <tilth/core/error.hpp>
#include <tilth/core/turn.hpp>
#include <tilth/gazebo/shapes.hpp>
#include <tilth/simulation/solids.hpp>

namespace tilth {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;

constexpr double kPoleRadius = 0.15;  // [m] below which an upright cylinder is an edge structure as a whole
constexpr double kWidest = 1e6;       // [m] from the origin

template <class V>
Vector3d vector_of(const V& v) {
  return {v.X(), v.Y(), v.Z()};
}

/// About its middle, where SDF has a box's origin.
void add_centred_box(Mesh& mesh, const Place& place, const Vector3d& size) {
  Pose T = place.T_world_shape;
  T.translation() -= T.linear().col(2) * (size.z() / 2);
  add_box(mesh, place.surface, T, size);
}

void add_plane(Mesh& mesh, const Place& place, const sdf::Plane& plane) {
  const Eigen::Matrix3d R = place.T_world_shape.linear() * least_turn(Vector3d::UnitZ(), vector_of(plane.Normal()));
  const Vector3d u = plane.Size().X() * R.col(0), v = plane.Size().Y() * R.col(1);
  add_quad(mesh, place.surface, place.T_world_shape.translation() - 0.5 * (u + v), {u, v}, kAllSides);
}

void add_cylinder_shape(Mesh& mesh, const Place& place, const sdf::Cylinder& cylinder) {
  mesh.surfaces[place.surface].slender = cylinder.Radius() < kPoleRadius && cylinder.Length() > 4 * cylinder.Radius();
  add_revolved(mesh, place.surface, Affine3d(place.T_world_shape),
               cylinder_profile(cylinder.Radius(), cylinder.Length()));
}

/// The middle of the box about all parts, to which <center> moves the origin.
Vector3d middle_of(const std::vector<const MeshPart*>& parts) {
  Eigen::AlignedBox3d box;
  for (const MeshPart* part : parts) {
    for (const Vector3d& vertex : part->mesh.vertices) box.extend(vertex);
  }
  return box.center();
}

/// The name of what a geometry holds that is not known here: <polyline>, <image> ...; empty where it holds nothing.
std::string kind_of(const sdf::Geometry& geometry) {
  const sdf::ElementPtr element = geometry.Element();
  const sdf::ElementPtr first = element ? element->GetFirstElement() : nullptr;
  return first && first->GetName() != "empty" ? first->GetName() : "";
}

bool finite_since(const Mesh& mesh, std::size_t vertex) {
  return std::all_of(mesh.vertices.begin() + std::ptrdiff_t(vertex), mesh.vertices.end(),
                     [](const Vector3d& v) { return v.cwiseAbs().maxCoeff() < kWidest; });
}

}  // namespace

void ShapeReader::add(Mesh& mesh, const Place& place, const sdf::Geometry& geometry) {
  const std::size_t vertex = mesh.vertices.size(), triangle = mesh.triangles.size();
  add_shape(mesh, place, geometry);
  if (!finite_since(mesh, vertex)) {
    warnings_.add(place.name + " has a size or pose that is no number or beyond 1000 km; left out");
    mesh.vertices.resize(vertex), mesh.triangles.resize(triangle);
  }
  for (std::size_t i = triangle; i < mesh.triangles.size(); ++i) mesh.triangles[i].edges = kNoSides;
  mark_edges(mesh, triangle);
}

void ShapeReader::add_shape(Mesh& mesh, const Place& place, const sdf::Geometry& geometry) {
  const Affine3d to_world(place.T_world_shape);
  if (const auto* box = geometry.BoxShape()) {
    add_centred_box(mesh, place, vector_of(box->Size()));
  } else if (const auto* cylinder = geometry.CylinderShape()) {
    add_cylinder_shape(mesh, place, *cylinder);
  } else if (const auto* sphere = geometry.SphereShape()) {
    add_revolved(mesh, place.surface, to_world, sphere_profile(sphere->Radius()));
  } else if (const auto* capsule = geometry.CapsuleShape()) {
    add_revolved(mesh, place.surface, to_world, capsule_profile(capsule->Radius(), capsule->Length()));
  } else if (const auto* ellipsoid = geometry.EllipsoidShape()) {
    const Vector3d radii = vector_of(ellipsoid->Radii());
    const double widest = radii.maxCoeff();
    const Affine3d flattened = to_world * Eigen::Scaling(Vector3d(radii / widest));
    add_revolved(mesh, place.surface, flattened, sphere_profile(widest));
  } else if (const auto* plane = geometry.PlaneShape()) {
    add_plane(mesh, place, *plane);
  } else if (const auto* shape = geometry.MeshShape()) {
    add_mesh(mesh, place, *shape);
  } else if (const std::string kind = kind_of(geometry); !kind.empty()) {
    warnings_.add(place.name + ": <" + kind + "> is a geometry that is not read; left out");
  }
}

void ShapeReader::add_mesh(Mesh& mesh, const Place& place, const sdf::Mesh& shape) {
  const std::vector<MeshPart>* all = parts_of(shape, place.name);
  if (!all) return;
  std::vector<const MeshPart*> parts;
  for (const MeshPart& part : *all) {
    const bool wanted = shape.Submesh().empty() || part.node == shape.Submesh() || part.name == shape.Submesh();
    if (wanted) parts.push_back(&part);
  }
  if (parts.empty()) {
    warnings_.add(place.name + ": " + shape.Uri() + " has no submesh \"" + shape.Submesh() + "\"; left out");
    return;
  }
  Affine3d to_world = Affine3d(place.T_world_shape) * Eigen::Scaling(vector_of(shape.Scale()));
  if (!shape.Submesh().empty() && shape.CenterSubmesh()) to_world.translate(-middle_of(parts));
  for (const MeshPart* part : parts) add_triangles(mesh, place.surface, to_world, part->mesh);
}

const std::vector<MeshPart>* ShapeReader::parts_of(const sdf::Mesh& shape, const std::string& name) {
  const std::filesystem::path beside = std::filesystem::path(shape.FilePath()).parent_path();
  const auto path = model_path_.find(shape.Uri(), beside);
  if (!path) {
    warnings_.add(name + ": mesh " + shape.Uri() + " is not found in " + model_path_.listing() + "; left out");
    return nullptr;
  }
  auto [file, fresh] = files_.try_emplace(path->string());
  try {
    if (fresh) file->second = read_mesh_file(*path);
  } catch (const Error& error) {
    warnings_.add(name + ": mesh " + shape.Uri() + ": " + error.what() + "; left out");
  }
  return file->second.empty() ? nullptr : &file->second;
}

}  // namespace tilth
