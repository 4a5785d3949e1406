#include <algorithm>
#include <cmath>

#include <tilth/simulation/mesh_points.hpp>

namespace tilth {
namespace {

using Eigen::Vector3d;

struct Corners {
  Vector3d a, b, c;
};

Corners corners_of(const Mesh& mesh, const Triangle& triangle) {
  const auto& v = triangle.vertices;
  return {mesh.vertices[v[0]], mesh.vertices[v[1]], mesh.vertices[v[2]]};
}

Vector3d closest_on_side(const Vector3d& from, const Vector3d& to, const Vector3d& p) {
  const Vector3d side = to - from;
  const double squared = side.squaredNorm();
  const double along = squared > 0 ? std::clamp((p - from).dot(side) / squared, 0.0, 1.0) : 0.0;
  return from + along * side;
}

/// The two numbers of a point of the plane, by which sequence `i` fills the unit square evenly (the R2 sequence of
/// M. Roberts, 2018: steps of the inverse of the plastic number and of its square).
Eigen::Vector2d even_in_square(std::size_t i) {
  constexpr double kStep = 0.7548776662466927, kSquare = 0.5698402909980532;
  const auto fraction = [](double x) { return x - std::floor(x); };
  return {fraction(0.5 + kStep * double(i)), fraction(0.5 + kSquare * double(i))};
}

}  // namespace

Vector3d closest_point(const Mesh& mesh, const Triangle& triangle, const Vector3d& p) {
  const auto [a, b, c] = corners_of(mesh, triangle);
  const Vector3d normal = (b - a).cross(c - a);
  const auto is_inside = [&](const Vector3d& from, const Vector3d& to) {
    return normal.cross(to - from).dot(p - from) >= 0;
  };
  if (normal.squaredNorm() > 0 && is_inside(a, b) && is_inside(b, c) && is_inside(c, a))
    return p - normal * (normal.dot(p - a) / normal.squaredNorm());
  Vector3d nearest = closest_on_side(a, b, p);
  for (const Vector3d& other : {closest_on_side(b, c, p), closest_on_side(c, a, p)})
    if ((other - p).squaredNorm() < (nearest - p).squaredNorm()) nearest = other;
  return nearest;
}

std::vector<Vector3d> sampled_surface(const Mesh& mesh, double spacing) {
  std::vector<Vector3d> points;
  double area = 0.5 * spacing * spacing;  // that no point stands for yet
  for (const Triangle& triangle : mesh.triangles) {
    const auto [a, b, c] = corners_of(mesh, triangle);
    area += 0.5 * (b - a).cross(c - a).norm();
    for (; area >= spacing * spacing; area -= spacing * spacing) {
      Eigen::Vector2d u = even_in_square(points.size());
      if (u.sum() > 1) u = Eigen::Vector2d::Ones() - u;
      points.push_back(a + u.x() * (b - a) + u.y() * (c - a));
    }
  }
  return points;
}

}  // namespace tilth
