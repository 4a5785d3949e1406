#include <algorithm>
#include <cmath>
#include <limits>

#include <sdf/Element.hh>

#include <tilth/gazebo/actors.hpp>
#include <tilth/gazebo/sdf_pose.hpp>

namespace tilth {
namespace {

using Eigen::Vector3d;

constexpr double kStep = 0.3;  // [m] above a way-point from which the ground is looked for

/// The height at which the upright line through `point` meets the triangle, if it does.
double height_under(const Mesh& mesh, const Triangle& triangle, const Vector3d& point) {
  constexpr double kNowhere = -std::numeric_limits<double>::infinity();
  const Vector3d &a = mesh.vertices[triangle.vertices[0]], &b = mesh.vertices[triangle.vertices[1]],
                 &c = mesh.vertices[triangle.vertices[2]];
  const Vector3d u = b - a, v = c - a, w = point - a;
  const double area = u.x() * v.y() - u.y() * v.x();
  if (std::abs(area) < 1e-12) return kNowhere;
  const double s = (w.x() * v.y() - w.y() * v.x()) / area, t = (u.x() * w.y() - u.y() * w.x()) / area;
  if (s < 0 || t < 0 || s + t > 1) return kNowhere;
  const double height = a.z() + s * u.z() + t * v.z();
  return height <= point.z() + kStep ? height : kNowhere;
}

Vector3d on_ground(const Mesh& ground, Vector3d point) {
  double height = -std::numeric_limits<double>::infinity();
  for (const Triangle& triangle : ground.triangles) height = std::max(height, height_under(ground, triangle, point));
  if (std::isfinite(height)) point.z() = height;
  return point;
}

Footing footing_at(double time, const Pose& T, const Mesh& ground) {
  const Vector3d forward = T.linear().col(0);
  return {time, on_ground(ground, T.translation()), std::atan2(forward.y(), forward.x())};
}

}  // namespace

ScriptedWalker walker_of(const sdf::Actor& actor, const std::string& sdf_version, const Mesh& ground) {
  const Pose T_world_actor = pose_of(actor.RawPose());
  const bool in_world = sdf_version < "1.7";
  ScriptedWalker walker;
  walker.loop = actor.ScriptLoop();
  walker.delay = std::max(0.0, actor.ScriptDelayStart());
  double begin = 0;
  for (std::uint64_t i = 0; i < actor.TrajectoryCount(); ++i) {
    const auto* trajectory = actor.TrajectoryByIndex(i);
    for (std::uint64_t k = 0; k < trajectory->WaypointCount(); ++k) {
      const auto* waypoint = trajectory->WaypointByIndex(k);
      const Pose T = pose_of(waypoint->Pose());
      const double time = std::max(0.0, waypoint->Time());
      walker.script.push_back(footing_at(begin + time, in_world ? T : T_world_actor * T, ground));
    }
    if (!walker.script.empty()) begin = walker.script.back().time;
  }
  const auto earlier = [](const Footing& a, const Footing& b) { return a.time < b.time; };
  std::stable_sort(walker.script.begin(), walker.script.end(), earlier);
  if (walker.script.empty()) walker.script.push_back(footing_at(0, T_world_actor, ground));
  return walker;
}

}  // namespace tilth
