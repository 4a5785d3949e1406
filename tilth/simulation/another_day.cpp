#include <algorithm>
#include <cmath>
#include <numbers>

#include <tilth/core/error.hpp>
#include <tilth/simulation/another_day.hpp>
#include <tilth/simulation/layout.hpp>

namespace tilth {
namespace {

using Eigen::Vector3d;

constexpr std::uint64_t kChanges = 0x90;
constexpr double kClearOfWay = 0.8;  // [m]

/// A motion about where a thing stands.
Eigen::Isometry3d moved_about(const Vector3d& foot, CounterRandom& random) {
  const double heading = random.uniform(0, 2 * std::numbers::pi), distance = random.uniform(0.3, 1.5);
  const double turn = random.uniform(-0.5, 0.5) * std::numbers::pi;
  return Eigen::Translation3d(foot + distance * Vector3d(std::cos(heading), std::sin(heading), 0)) *
         Eigen::AngleAxisd(turn, Vector3d::UnitZ()) * Eigen::Translation3d(-foot);
}

bool stays_clear(const std::vector<Vector3d>& vertices, const Path& way) {
  return std::all_of(vertices.begin(), vertices.end(),
                     [&](const Vector3d& vertex) { return distance_to(way, vertex) > kClearOfWay; });
}

std::vector<Vector3d> moved_vertices(const Mesh& mesh, const MovablePart& part, const Eigen::Isometry3d& motion) {
  std::vector<Vector3d> vertices;
  for (std::size_t i = part.vertices[0]; i < part.vertices[1]; ++i) vertices.push_back(motion * mesh.vertices[i]);
  return vertices;
}

/// Another thing of the same kind.
void add_copy(Mesh& mesh, const MovablePart& part, const std::vector<Vector3d>& vertices) {
  const std::size_t first = mesh.vertices.size();
  mesh.vertices.insert(mesh.vertices.end(), vertices.begin(), vertices.end());
  for (std::size_t i = part.triangles[0]; i < part.triangles[1]; ++i) {
    Triangle triangle = mesh.triangles[i];
    for (std::uint32_t& vertex : triangle.vertices) vertex = std::uint32_t(vertex - part.vertices[0] + first);
    mesh.triangles.push_back(triangle);
  }
}

}  // namespace

void change(Scene& scene, const SceneOptions& options) {
  Mesh& mesh = scene.mesh;
  CounterRandom random(options.seed, kChanges);
  const Path way = footprint(scene.trajectory);
  std::vector<bool> gone(mesh.triangles.size(), false);
  for (const MovablePart& part : mesh.movables) {
    const bool changes = random.chance(options.changed);
    const double how = random.uniform(0, 3);
    const std::vector<Vector3d> elsewhere = moved_vertices(mesh, part, moved_about(part.foot, random));
    if (!changes) continue;
    const bool fits = stays_clear(elsewhere, way);
    if (how < 2 && fits)
      how < 1 ? add_copy(mesh, part, elsewhere)
              : void(std::copy(elsewhere.begin(), elsewhere.end(),
                               mesh.vertices.begin() + std::ptrdiff_t(part.vertices[0])));
    else
      std::fill(gone.begin() + std::ptrdiff_t(part.triangles[0]), gone.begin() + std::ptrdiff_t(part.triangles[1]),
                true);
  }
  std::vector<Triangle> left;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    if (i >= gone.size() || !gone[i]) left.push_back(mesh.triangles[i]);
  mesh.triangles = std::move(left);
  mesh.movables.clear();  // their triangles have other numbers now
}

Trajectory kidnapped(const Trajectory& way, const SceneOptions& options) {
  const auto begin =
      std::find_if(way.begin(), way.end(), [&](const auto& pose) { return pose.stamp >= options.kidnap; });
  auto end = begin;
  for (double carried = 0; end + 1 < way.end() && carried < options.kidnap_jump; ++end)
    carried += ((end + 1)->T_world_lidar.translation() - end->T_world_lidar.translation()).norm();
  if (begin == way.end() || end + 1 >= way.end())
    throw Error("kidnap", "comes too late: the way ends at " + std::to_string(way.back().stamp) +
                              " s, and there is less of it left than kidnap_jump");
  Trajectory jumped(way.begin(), begin);
  const double first = begin->stamp, step = 1 / kTruthRate;
  const auto rests = std::size_t(std::lround(options.covered * kTruthRate));
  for (std::size_t i = 0; i < rests; ++i) jumped.push_back({first + double(i) * step, end->T_world_lidar});
  const double later = first + double(rests) * step - end->stamp;
  for (auto pose = end; pose != way.end(); ++pose) jumped.push_back({pose->stamp + later, pose->T_world_lidar});
  return jumped;
}

bool is_covered(double stamp, const SceneOptions& options) {
  return options.kidnap > 0 && stamp >= options.kidnap && stamp < options.kidnap + options.covered;
}

}  // namespace tilth
