#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include <tilth/simulation/solids.hpp>

namespace tilth {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kSagitta = 0.0005;  // [m] between a circle and the chords inside it
constexpr int kLeastSegments = 24, kMostSegments = 448;
constexpr double kWeld = 1e-6;             // [m] within which two vertices are one
constexpr double kEdgeCosine = 0.8660254;  // of 30 degrees
constexpr double kLeastArea = 1e-14;       // [m^2] twice that of a triangle worth keeping

/// Of a full turn, a multiple of four.
int segments_of(double radius) {
  if (radius <= kSagitta) return kLeastSegments;
  const double half_step = std::acos(1 - kSagitta / radius);
  const int segments = 4 * int(std::ceil(std::numbers::pi / half_step / 4));
  return std::clamp(segments, kLeastSegments, kMostSegments);
}

/// A quarter of a circle about (0, height), from `begin` on.
void append_arc(Profile& profile, double radius, double height, double begin) {
  const int steps = segments_of(radius) / 4;
  for (int i = 0; i <= steps; ++i) {
    const double angle = begin + 0.5 * std::numbers::pi * i / steps;
    profile.emplace_back(std::max(0.0, radius * std::cos(angle)), height + radius * std::sin(angle));
  }
}

Vector3d normal_of(const Mesh& mesh, const Triangle& triangle) {
  const auto& [a, b, c] = triangle.vertices;
  return (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
}

void add_if_it_has_an_area(Mesh& mesh, const Triangle& triangle) {
  if (normal_of(mesh, triangle).norm() > kLeastArea) mesh.triangles.push_back(triangle);
}

/// Numbers vertices by where they are.
class Welder {
 public:
  std::size_t number_of(const Vector3d& vertex) {
    const std::array<long long, 3> cell{std::llround(vertex.x() / kWeld), std::llround(vertex.y() / kWeld),
                                        std::llround(vertex.z() / kWeld)};
    return numbers_.try_emplace(cell, numbers_.size()).first->second;
  }

 private:
  std::map<std::array<long long, 3>, std::size_t> numbers_;
};

using Side = std::pair<std::size_t, std::size_t>;  // numbers of its two vertices, the smaller first

struct SideUse {
  Vector3d normal = Vector3d::Zero();  // of the first triangle that has it
  int triangles = 0;
  bool sharp = false;

  void add(const Vector3d& other) {
    if (triangles++ == 0) normal = other;
    sharp = sharp || std::abs(normal.dot(other)) < kEdgeCosine;
  }
};

}  // namespace

Profile sphere_profile(double radius) {
  return capsule_profile(radius, 0);
}

Profile cylinder_profile(double radius, double length) {
  return {{0, -length / 2}, {radius, -length / 2}, {radius, length / 2}, {0, length / 2}};
}

Profile capsule_profile(double radius, double length) {
  Profile profile;
  append_arc(profile, radius, -length / 2, -0.5 * std::numbers::pi);
  append_arc(profile, radius, length / 2, 0);
  return profile;
}

void add_revolved(Mesh& mesh, SurfaceId surface, const Eigen::Affine3d& to_world, std::span<const Vector2d> profile) {
  double radius = 0;
  for (const Vector2d& corner : profile) radius = std::max(radius, corner.x());
  const double scale = to_world.linear().colwise().norm().maxCoeff();
  const auto segments = std::uint32_t(segments_of(scale * radius));
  const auto first = std::uint32_t(mesh.vertices.size());
  for (const Vector2d& corner : profile) {
    for (std::uint32_t i = 0; i < segments; ++i) {
      const double angle = 2 * std::numbers::pi * i / segments;
      mesh.vertices.push_back(to_world *
                              Vector3d(corner.x() * std::cos(angle), corner.x() * std::sin(angle), corner.y()));
    }
  }
  for (std::uint32_t row = 0; row + 1 < profile.size(); ++row) {
    for (std::uint32_t i = 0; i < segments; ++i) {
      const std::uint32_t a = first + row * segments + i, b = first + row * segments + (i + 1) % segments;
      add_if_it_has_an_area(mesh, {{a, b, b + segments}, surface, kNoSides});
      add_if_it_has_an_area(mesh, {{a, b + segments, a + segments}, surface, kNoSides});
    }
  }
}

void add_triangles(Mesh& mesh, SurfaceId surface, const Eigen::Affine3d& to_world, const Mesh& part) {
  const auto first = std::uint32_t(mesh.vertices.size());
  for (const Vector3d& vertex : part.vertices) mesh.vertices.push_back(to_world * vertex);
  for (const Triangle& triangle : part.triangles) {
    const auto& [a, b, c] = triangle.vertices;
    add_if_it_has_an_area(mesh, {{first + a, first + b, first + c}, surface, kNoSides});
  }
}

void mark_edges(Mesh& mesh, std::size_t first) {
  Welder welder;
  std::map<Side, SideUse> uses;
  std::vector<std::array<Side, 3>> sides;
  for (std::size_t t = first; t < mesh.triangles.size(); ++t) {
    const Triangle& triangle = mesh.triangles[t];
    std::array<std::size_t, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = welder.number_of(mesh.vertices[triangle.vertices[i]]);
    const Vector3d normal = normal_of(mesh, triangle).normalized();
    auto& own = sides.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      own[i] = std::minmax(corners[i], corners[(i + 1) % 3]);
      uses[own[i]].add(normal);
    }
  }
  for (std::size_t t = first; t < mesh.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const SideUse& use = uses.at(sides[t - first][i]);
      if (use.triangles == 1 || use.sharp) mesh.triangles[t].edges |= std::uint8_t(1u << i);
    }
  }
}

}  // namespace tilth
