#include <algorithm>
#include <cmath>
#include <cstdio>

#include <tilth/core/error.hpp>
#include <tilth/simulation/path.hpp>

namespace tilth {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kStill = 1e-9;  // [m], [rad] within which two poses are the same

Vector3d rotation_vector(const Quaterniond& q) {
  const Eigen::AngleAxisd turn(q.w() < 0 ? Quaterniond(-q.coeffs()) : q);
  return turn.angle() * turn.axis();
}

Quaterniond quaternion(const Vector3d& rotation) {
  return Quaterniond(Eigen::AngleAxisd(rotation.norm(), rotation.stableNormalized()));
}

/// A pose with its velocity.
struct Node {
  double time;        // [s]
  Vector3d position;  // [m]
  Quaterniond rotation;
  Vector3d velocity = Vector3d::Zero();   // [m/s] in the world
  Vector3d turn_rate = Vector3d::Zero();  // [rad/s] in the sensor's frame
};

/// The slope at the middle of three values, of the parabola through them; at rest where one of its neighbours is the
/// same, so that a stop stays a stop.
Vector3d middle_slope(const Vector3d& before, const Vector3d& after, double time_before, double time_after) {
  if (before.norm() < kStill || after.norm() < kStill) return Vector3d::Zero();
  return (time_after / time_before * before + time_before / time_after * after) / (time_before + time_after);
}

Vector3d turn_between(const Node& from, const Node& to) {
  return rotation_vector(from.rotation.conjugate() * to.rotation);
}

std::vector<Node> nodes_of(const Trajectory& poses) {
  std::vector<Node> nodes;
  for (const StampedPose& pose : poses) {
    const Pose& T = pose.T_world_lidar;
    nodes.push_back({pose.stamp - poses.front().stamp, T.translation(), Quaterniond(T.linear()).normalized()});
  }
  for (std::size_t i = 1; i + 1 < nodes.size(); ++i) {
    const Node &before = nodes[i - 1], &after = nodes[i + 1];
    Node& node = nodes[i];
    const double h0 = node.time - before.time, h1 = after.time - node.time;
    node.velocity = middle_slope(node.position - before.position, after.position - node.position, h0, h1);
    node.turn_rate = middle_slope(turn_between(before, node), turn_between(node, after), h0, h1);
  }
  if (nodes.size() == 2)
    nodes[0].velocity = nodes[1].velocity = (nodes[1].position - nodes[0].position) / nodes[1].time;
  for (const auto& [end, next] : {std::pair{&nodes.front(), &nodes[1]}, {&nodes.back(), &nodes[nodes.size() - 2]}}) {
    const double h = next->time - end->time;
    end->velocity = 1.5 * (next->position - end->position) / h - 0.5 * next->velocity;
    end->turn_rate = turn_between(*end, *next) / h;
  }
  return nodes;
}

Vector3d position_between(const Node& a, const Node& b, double s) {
  const double h = b.time - a.time, s2 = s * s, s3 = s2 * s;
  return (2 * s3 - 3 * s2 + 1) * a.position + (s3 - 2 * s2 + s) * h * a.velocity + (3 * s2 - 2 * s3) * b.position +
         (s3 - s2) * h * b.velocity;
}

Quaterniond rotation_between(const Node& a, const Node& b, double s) {
  const double h = b.time - a.time, r = 1 - s;
  const Vector3d first = h / 3 * a.turn_rate, last = h / 3 * b.turn_rate;
  const Vector3d middle = rotation_vector(quaternion(-first) * a.rotation.conjugate() * b.rotation * quaternion(-last));
  return a.rotation * quaternion((1 - r * r * r) * first) * quaternion((3 - 2 * s) * s * s * middle) *
         quaternion(s * s * s * last);
}

void check(const Trajectory& poses) {
  if (poses.size() < 2) throw Error("path", "has fewer than two poses");
  char text[96];
  for (std::size_t i = 1; i < poses.size(); ++i) {
    if (poses[i].stamp > poses[i - 1].stamp) continue;
    std::snprintf(text, sizeof text, "the stamp %.9g s follows %.9g s: stamps must ascend strictly", poses[i].stamp,
                  poses[i - 1].stamp);
    throw Error("path", text);
  }
  const double duration = poses.back().stamp - poses.front().stamp;
  if (duration <= kLongestDrive) return;
  std::snprintf(text, sizeof text, "takes %.9g s, more than %g s", duration, kLongestDrive);
  throw Error("path", text);
}

}  // namespace

Trajectory follow(const Trajectory& poses, const MotionOptions& motion) {
  check(poses);
  const std::vector<Node> nodes = nodes_of(poses);
  const auto last = std::size_t(std::floor(nodes.back().time / motion.speed_scale * kTruthRate + 1e-6));
  Trajectory trajectory;
  std::size_t next = 1;
  for (std::size_t i = 0; i <= last; ++i) {
    const double time = double(i) / kTruthRate, at = time * motion.speed_scale;
    while (next + 1 < nodes.size() && nodes[next].time <= at) ++next;
    const Node &a = nodes[next - 1], &b = nodes[next];
    const double s = std::min(1.0, (at - a.time) / (b.time - a.time));
    Pose T = Pose::Identity();
    T.translation() = position_between(a, b, s);
    T.linear() = rotation_between(a, b, s).normalized().toRotationMatrix();
    trajectory.push_back({time, shaken(T, time, motion)});
  }
  return trajectory;
}

}  // namespace tilth
