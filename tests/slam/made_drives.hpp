// Drives through made corridors with known truth, and an odometry that drifts by a known amount: loop closure alone is
// on trial, at the cost of the simulation.
#pragma once

#include <numbers>
#include <vector>

#include <tilth/odometry/odometry.hpp>
#include <tilth/simulation/simulator.hpp>

namespace tilth {

/// A corridor along x, 2.4 m wide and 3 m high, with doors on either side.
struct CorridorPlan {
  double length;              ///< [m]
  std::vector<double> doors;  ///< [m] where each begins, ascending
  bool closed = true;         ///< a wall at either end
};

/// The corridor, driven by `legs` from 2 m behind its beginning.
inline Scene corridor_scene(const CorridorPlan& plan, const std::vector<Leg>& legs) {
  constexpr double kHalfWidth = 1.2, kHeight = 3.0, kLidarHeight = 0.8;
  Scene scene;
  Mesh& mesh = scene.mesh;
  const SurfaceId wall = add_surface(mesh, {"wall"}), door = add_surface(mesh, {"door"});
  std::vector<Opening> right, left;
  const double length = plan.length;
  for (const double at : plan.doors) {
    right.push_back({.at = at, .recess = 0.1, .panel = int(door)});
    left.insert(left.begin(), {.at = length - at - 1.0, .recess = 0.1, .panel = int(door)});
  }
  add_wall(mesh, wall, {{0, -kHalfWidth, 0}, {length, -kHalfWidth, 0}, kHeight, right});
  add_wall(mesh, wall, {{length, kHalfWidth, 0}, {0, kHalfWidth, 0}, kHeight, left});
  if (plan.closed) {
    add_wall(mesh, wall, {{0, kHalfWidth, 0}, {0, -kHalfWidth, 0}, kHeight, {}});
    add_wall(mesh, wall, {{length, -kHalfWidth, 0}, {length, kHalfWidth, 0}, kHeight, {}});
  }
  for (const double z : {0.0, kHeight})
    add_quad(mesh, wall, {0, -kHalfWidth, z}, {Eigen::Vector3d(length, 0, 0), Eigen::Vector3d(0, 2 * kHalfWidth, 0)},
             kNoSides);
  scene.trajectory = drive(legs, upright({2, 0, kLidarHeight}, 0), {.speed_scale = 1.0});
  return scene;
}

inline Simulator simulated(Scene scene) {
  return Simulator(std::move(scene), simulation_options("corridor", {{"seed", "301"}, {"people", "0"}}));
}

/// How an odometry errs on the way.
struct Drift {
  double scale = 0.0;  ///< [m/m] too long
  double turn = 0.0;   ///< [rad/m] to the left
};

/// The truth of a simulator, but for a drift.
class DriftingOdometry : public Odometry {
 public:
  DriftingOdometry(const Simulator& simulator, const Drift& drift) : truth_(simulator.truth()), drift_(drift) {}

  OdometryResult register_scan(const Scan& scan) override {
    constexpr double kStep = 0.01;  // [s]
    OdometryResult result;
    result.stamp = scan.stamp + 0.5 * duration(scan.cloud);
    const Pose T_truth = interpolate(truth_, result.stamp), T_later = interpolate(truth_, result.stamp + kStep);
    result.motion.velocity = log(T_truth.inverse() * T_later) / kStep;
    Pose motion = first_ ? Pose(Pose::Identity()) : Pose(T_truth_last_.inverse() * T_truth);
    const double path = motion.translation().norm();
    motion.translation() *= 1 + drift_.scale;
    T_world_lidar_ = T_world_lidar_ * motion * Eigen::AngleAxisd(drift_.turn * path, Eigen::Vector3d::UnitZ());
    T_truth_last_ = T_truth;
    first_ = false;
    result.T_world_lidar = T_world_lidar_;
    result.alignment.converged = true;
    result.filtered = scan.cloud;
    return result;
  }
  PointCloud local_map() const override { return {}; }

 private:
  const Trajectory& truth_;
  Drift drift_;
  Pose T_world_lidar_ = Pose::Identity(), T_truth_last_ = Pose::Identity();
  bool first_ = true;
};

/// The true motion from the instant `a` to `b` [s].
inline Pose true_motion(const Simulator& simulator, double a, double b) {
  return interpolate(simulator.truth(), a).inverse() * interpolate(simulator.truth(), b);
}

}  // namespace tilth
