#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include <tilth/simulation/mesh.hpp>

namespace tilth {
namespace {

using Eigen::Vector3d;

/// One wall in the making: along it, up, and away from the room.
struct WallFrame {
  Vector3d foot, along, behind;

  Vector3d at(double s, double z, double depth = 0.0) const {
    return foot + s * along + z * Vector3d::UnitZ() + depth * behind;
  }
};

void add_panel(Mesh& mesh, SurfaceId surface, const WallFrame& wall, const std::array<double, 4>& range,
               std::uint8_t edges) {
  const auto [s0, s1, z0, z1] = range;
  if (s1 - s0 < 1e-9 || z1 - z0 < 1e-9) return;
  add_quad(mesh, surface, wall.at(s0, z0), {(s1 - s0) * wall.along, Vector3d(0, 0, z1 - z0)}, edges);
}

void add_opening(Mesh& mesh, SurfaceId surface, const WallFrame& wall, const Opening& opening) {
  const double s0 = opening.at, s1 = opening.at + opening.width, z0 = opening.bottom, z1 = opening.top;
  const Vector3d deep = opening.recess * wall.behind, wide = (s1 - s0) * wall.along, high(0, 0, z1 - z0);
  add_quad(mesh, surface, wall.at(s0, z0), {high, deep}, kAllSides);
  add_quad(mesh, surface, wall.at(s1, z0), {deep, high}, kAllSides);
  add_quad(mesh, surface, wall.at(s0, z1), {deep, wide}, kAllSides);
  if (z0 > 0) add_quad(mesh, surface, wall.at(s0, z0), {wide, deep}, kAllSides);
  if (opening.panel == Opening::kPassage) return;
  add_quad(mesh, SurfaceId(opening.panel), wall.at(s0, z0, opening.recess), {wide, high}, kAllSides);
}

}  // namespace

SurfaceId add_surface(Mesh& mesh, Surface surface) {
  assert(mesh.surfaces.size() < std::numeric_limits<SurfaceId>::max());
  mesh.surfaces.push_back(std::move(surface));
  return SurfaceId(mesh.surfaces.size() - 1);
}

void add_quad(Mesh& mesh, SurfaceId surface, const Vector3d& corner, const std::array<Vector3d, 2>& sides,
              std::uint8_t edges) {
  const std::uint32_t first = std::uint32_t(mesh.vertices.size());
  const auto& [u, v] = sides;
  mesh.vertices.insert(mesh.vertices.end(), {corner, corner + u, corner + u + v, corner + v});
  mesh.triangles.push_back({{first, first + 1, first + 2}, surface, std::uint8_t(edges & 0b011)});
  mesh.triangles.push_back({{first, first + 2, first + 3}, surface, std::uint8_t((edges >> 1) & 0b110)});
}

void add_box(Mesh& mesh, SurfaceId surface, const Pose& T_world_box, const Vector3d& size) {
  const Eigen::Matrix3d axes = T_world_box.linear() * size.asDiagonal();
  const Vector3d x = axes.col(0), y = axes.col(1), z = axes.col(2);
  const Vector3d low = T_world_box.translation() - 0.5 * (x + y), high = low + x + y + z;
  add_quad(mesh, surface, low, {y, x}, kAllSides);
  add_quad(mesh, surface, low, {x, z}, kAllSides);
  add_quad(mesh, surface, low, {z, y}, kAllSides);
  add_quad(mesh, surface, high, {-x, -y}, kAllSides);
  add_quad(mesh, surface, high, {-z, -x}, kAllSides);
  add_quad(mesh, surface, high, {-y, -z}, kAllSides);
}

void add_cylinder(Mesh& mesh, SurfaceId surface, const Pose& T_world_base, double radius, double height) {
  const int segments = radius > 1 ? 48 : 16;
  const Vector3d up = height * T_world_base.linear().col(2);
  const auto rim = [&](int i) -> Vector3d {
    const double angle = 2 * std::numbers::pi * i / segments;
    return T_world_base * (radius * Vector3d(std::cos(angle), std::sin(angle), 0));
  };
  for (int i = 0; i < segments; ++i) {
    const Vector3d a = rim(i), b = rim(i + 1);
    add_quad(mesh, surface, a, {b - a, up}, 0b0101);
    const std::uint32_t first = std::uint32_t(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), {a + up, b + up, T_world_base.translation() + up});
    mesh.triangles.push_back({{first, first + 1, first + 2}, surface, 0b001});
  }
}

void add_wall(Mesh& mesh, SurfaceId surface, const Wall& wall) {
  const double length = (wall.to - wall.from).norm();
  const Vector3d along = (wall.to - wall.from) / length;
  const WallFrame frame{wall.from, along, along.cross(Vector3d::UnitZ())};
  double start = 0;
  for (const Opening& opening : wall.openings) {
    const double s0 = opening.at, s1 = opening.at + opening.width;
    assert(s0 >= start && s1 <= length && opening.top <= wall.height);
    add_panel(mesh, surface, frame, {start, s0, 0, wall.height}, kAllSides);
    add_panel(mesh, surface, frame, {s0, s1, opening.top, wall.height}, 0b0101);
    add_panel(mesh, surface, frame, {s0, s1, 0, opening.bottom}, 0b0101);
    add_opening(mesh, surface, frame, opening);
    start = s1;
  }
  add_panel(mesh, surface, frame, {start, length, 0, wall.height}, kAllSides);
}

Pose upright(const Vector3d& position, double yaw) {
  Pose T = Pose::Identity();
  T.linear() = Eigen::AngleAxisd(yaw, Vector3d::UnitZ()).toRotationMatrix();
  T.translation() = position;
  return T;
}

}  // namespace tilth
