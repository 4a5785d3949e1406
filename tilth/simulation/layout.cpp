#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <tilth/simulation/layout.hpp>

namespace tilth {
namespace {

using Eigen::Vector3d;

constexpr double kPersonClear = 0.6;  // [m] between a person's axis and the sensor

Vector3d heading_at(const Trajectory& trajectory, double stamp) {
  return interpolate(trajectory, stamp).linear().col(0);
}

Vector3d left_of(const Vector3d& along) {
  return Vector3d::UnitZ().cross(along);
}

/// Where two lines in the plane meet.
Vector3d crossing(const Vector3d& p, const Vector3d& u, const Vector3d& q, const Vector3d& v) {
  const Vector3d across = left_of(v);
  return p + across.dot(q - p) / across.dot(u) * u;
}

bool ring(const Path& path) {
  return path.size() > 3 && (path.front() - path.back()).norm() < 1e-6;
}

bool comes_near(const Walker& walker, const Trajectory& trajectory) {
  return std::any_of(trajectory.begin(), trajectory.end(), [&](const StampedPose& pose) {
    const Vector3d apart = pose_at(walker, pose.stamp).translation() - pose.T_world_lidar.translation();
    return apart.head<2>().norm() < kPersonClear;
  });
}

struct Nearest {
  double arc = 0, distance = std::numeric_limits<double>::infinity();
};

Nearest nearest_on(const Path& path, const Vector3d& point) {
  Nearest best;
  double before = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vector3d side = path[i] - path[i - 1];
    const double ratio = std::clamp((point - path[i - 1]).dot(side) / side.squaredNorm(), 0.0, 1.0);
    const double distance = (point - path[i - 1] - ratio * side).head<2>().norm();
    if (distance < best.distance) best = {before + ratio * side.norm(), distance};
    before += side.norm();
  }
  return best;
}

}  // namespace

Path path_of(std::span<const Leg> legs) {
  MotionOptions still;
  still.wobble = still.weave = 0;
  const Trajectory trajectory = drive(legs, Pose::Identity(), still);
  const auto place = [&](double stamp) -> Vector3d {
    const Vector3d p = interpolate(trajectory, stamp).translation();
    return {p.x(), p.y(), 0};
  };
  Path path{place(0)};
  double stamp = 0;
  for (const Leg& leg : legs) {
    const double end = stamp + leg.duration;
    if (std::abs(leg.turn) > 0.2) {
      path.push_back(crossing(place(stamp), heading_at(trajectory, stamp), place(end), heading_at(trajectory, end)));
    }
    stamp = end;
  }
  path.push_back(place(stamp));
  return path;
}

Path offset(const Path& path, double left) {
  Path moved;
  const std::size_t last = path.size() - 1;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const std::size_t before = i > 0 ? i - 1 : ring(path) ? last - 1 : 0;
    const std::size_t after = i < last ? i + 1 : ring(path) ? 1 : last;
    const Vector3d in = (i == before ? path[1] - path[0] : path[i] - path[before]).normalized();
    const Vector3d out = (i == after ? in : path[after] - path[i]).normalized();
    const Vector3d mitre = (left_of(in) + left_of(out)).normalized();
    moved.push_back(path[i] + left / mitre.dot(left_of(in)) * mitre);
  }
  return moved;
}

Path lengthened(Path path, double more) {
  const std::size_t n = path.size();
  const Vector3d first = (path[0] - path[1]).normalized(), last = (path[n - 1] - path[n - 2]).normalized();
  path[0] += more * first;
  path[n - 1] += more * last;
  return path;
}

double length_of(const Path& path) {
  double length = 0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  return length;
}

double arc_of(const Path& path, const Vector3d& point) {
  return nearest_on(path, point).arc;
}

double distance_to(const Path& path, const Vector3d& point) {
  return nearest_on(path, point).distance;
}

Path footprint(const Trajectory& trajectory) {
  const auto on_floor = [](const StampedPose& pose) -> Vector3d {
    return {pose.T_world_lidar.translation().x(), pose.T_world_lidar.translation().y(), 0};
  };
  Path path{on_floor(trajectory.front())};
  for (const StampedPose& pose : trajectory) {
    if ((on_floor(pose) - path.back()).norm() > 0.25) path.push_back(on_floor(pose));
  }
  return path;
}

std::vector<Path> outlines(const Path& path, double half_width) {
  Path right = offset(path, -half_width), left = offset(path, half_width);
  std::reverse(left.begin(), left.end());
  if (ring(path)) {
    right.pop_back(), left.pop_back();
    return {right, left};
  }
  right.insert(right.end(), left.begin(), left.end());
  return {right};
}

MotionOptions motion_of(const SceneOptions& options) {
  MotionOptions motion;
  motion.speed_scale = options.speed;
  motion.vibration = options.vibration;
  motion.vibration_angle = options.vibration_angle * std::numbers::pi / 180;
  motion.seed = options.seed;
  return motion;
}

Trajectory cut(Trajectory trajectory, double duration) {
  if (duration <= 0) return trajectory;
  const auto kept = std::size_t(std::ceil(duration * kTruthRate)) + 1;
  trajectory.resize(std::min(trajectory.size(), kept));
  return trajectory;
}

Trajectory travel(std::span<const Leg> legs, const SceneOptions& options) {
  return cut(drive(legs, upright(Vector3d(0, 0, options.height), 0), motion_of(options)), options.duration);
}

CounterRandom random_of_people(const CounterRandom& of_scene, const SceneOptions& options) {
  constexpr std::uint64_t kPeople = 0x80;
  return options.world_seed > 0 ? CounterRandom(options.seed, kPeople) : of_scene;
}

std::vector<Walker> walkers_beside(const Path& path, int count, double beside, CounterRandom& random) {
  std::vector<Walker> walkers;
  const double length = length_of(path);
  for (int i = 0; i < count; ++i) {
    Walker walker{offset(path, i % 2 == 0 ? beside : -beside)};
    walker.speed = random.uniform(0.8, 1.4);
    walker.start = length * (0.3 + (i + random.uniform()) / count);
    walker.height = random.uniform(1.6, 1.9);
    walkers.push_back(std::move(walker));
  }
  return walkers;
}

std::vector<Walker> kept_clear(std::vector<Walker> walkers, const Trajectory& trajectory) {
  std::vector<Walker> clear;
  for (Walker& walker : walkers) {
    for (int attempt = 0; attempt < 30 && comes_near(walker, trajectory); ++attempt) walker.start += 1.3;
    if (!comes_near(walker, trajectory)) clear.push_back(std::move(walker));
  }
  return clear;
}

}  // namespace tilth
