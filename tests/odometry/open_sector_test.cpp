// Scans of which a sector returns nothing, on a platform that shakes: what is left of a scan does not change how it is
// straightened, neither for the registration, nor for the map, nor for outputs.
#include <gtest/gtest.h>

#include <tilth/odometry/make_odometry.hpp>
#include <tilth/preprocess/deskew.hpp>
#include <tilth/simulation/simulator.hpp>

namespace tilth {
namespace {

/// The scan without the last quarter of its turn, but for a few returns from nowhere at the very end.
Scan open_sector(const Scan& scan) {
  const double end = duration(scan.cloud);
  std::vector<std::uint32_t> left;
  for (std::uint32_t i = 0; i < scan.cloud.size(); ++i) {
    if (double(scan.cloud.times[i]) < 0.75 * end) left.push_back(i);
  }
  Scan open{scan.stamp, select(scan.cloud, left)};
  open.cloud.points.push_back({60, 60, 20});
  open.cloud.times.push_back(float(end));
  if (!open.cloud.intensities.empty()) open.cloud.intensities.push_back(0);
  open.cloud.rings.push_back(15);
  return open;
}

Simulator shaking_plaza() {
  return Simulator("plaza", simulation_options("plaza", {{"seed", "7"}, {"people", "0"}, {"vibration_angle", "0.2"}}));
}

TEST(OpenSector, AScanIsStraightenedAsItWasRegistered) {
  const Simulator simulator = shaking_plaza();
  const auto odometry = make_odometry("tilth", {});
  double error = 0, by_velocity_alone = 0;  // [m] summed over points
  for (std::size_t i = 100; i < 150; ++i) {
    const Scan scan = open_sector(simulator.scan(i).scan);
    const OdometryResult result = odometry->register_scan(scan);
    if (i < 120) continue;
    const double pose_time = result.stamp - scan.stamp;
    const PointCloud straight = deskew(result.filtered, result.motion, pose_time);
    const PointCloud by_velocity = deskew(result.filtered, {result.motion.velocity}, pose_time);
    const Pose T_lidar_world = interpolate(simulator.truth(), result.stamp).inverse();
    for (std::size_t k = 0; k < result.filtered.size(); k += 50) {
      const Pose T_world_then = interpolate(simulator.truth(), scan.stamp + double(result.filtered.times[k]));
      const Eigen::Vector3d truth = T_lidar_world * T_world_then * result.filtered.points[k];
      error += (straight.points[k] - truth).norm();
      by_velocity_alone += (by_velocity.points[k] - truth).norm();
    }
  }
  EXPECT_LT(error, 0.5 * by_velocity_alone) << "or else the vibration is put where it was not";
}

TEST(OpenSector, TheMapIsMadeOfScansAsTheyWereRegistered) {
  const Simulator simulator = shaking_plaza();
  const auto odometry = make_odometry("tilth", {});
  Pose T_truth_world = Pose::Identity();
  double shift = 0, turn = 0;  // [m, rad] on average
  for (std::size_t i = 100; i < 160; ++i) {
    const OdometryResult result = odometry->register_scan(open_sector(simulator.scan(i).scan));
    const Pose T_truth = interpolate(simulator.truth(), result.stamp);
    if (i == 100) T_truth_world = T_truth * result.T_world_lidar.inverse();
    if (i < 120) continue;
    const Pose error = T_truth.inverse() * T_truth_world * result.T_world_lidar;
    shift += error.translation().norm() / 40, turn += angle_of(error) / 40;
  }
  EXPECT_LT(shift, 0.014);
  EXPECT_LT(turn, 0.0075);
}

}  // namespace
}  // namespace tilth
