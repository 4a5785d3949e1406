// The schedule of LeGO-LOAM, the instant of its poses, and how it follows a simulated plaza.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <tilth/odometry/lego_loam.hpp>
#include <tilth/simulation/simulator.hpp>

namespace tilth {
namespace {

// A hall of 12 x 9 m and 4 m, as a VLP-16 at its centre sees it that moves along x, 0.8 m above the floor.
Scan hall(double stamp, double x) {
  Scan scan{stamp, {}};
  for (int i = 0; i < 1800; ++i) {
    for (int ring = 0; ring < 16; ++ring) {
      const double azimuth = -i * 0.2 * M_PI / 180, elevation = (2 * ring - 15) * M_PI / 180;
      const Eigen::Vector3d d(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                              std::sin(elevation));
      const double to_x = (d.x() > 0 ? 6 - x : 6 + x) / std::abs(d.x()), to_y = 4.5 / std::abs(d.y()),
                   to_z = (d.z() > 0 ? 3.2 : 0.8) / std::abs(d.z());
      scan.cloud.points.push_back(std::min({to_x, to_y, to_z}) * d);
      scan.cloud.rings.push_back(std::uint16_t(ring));
      scan.cloud.times.push_back(float(i * 0.1 / 1800));
    }
  }
  return scan;
}

// Which of `scans` scans, 0.1 s apart, are mapped.
std::vector<int> mapped(const LegoLoamOptions& options, int scans) {
  LegoLoam odometry(options);
  std::vector<int> which;
  int now = 0;
  odometry.listen([&](std::string_view stage) {
    if (stage == "mapping") which.push_back(now);
  });
  for (; now < scans; ++now) odometry.register_scan(hall(0.1 * now, 0));
  return which;
}

TEST(LegoLoam, MapsEveryFourthScanAtTenHertz) {
  EXPECT_EQ(mapped({}, 10), (std::vector<int>{0, 4, 8}));
  LegoLoamOptions every;
  every.mapping.every = 1;
  EXPECT_EQ(mapped(every, 7), (std::vector<int>{0, 3, 6}));
  every.mapping.interval = 0;
  EXPECT_EQ(mapped(every, 3), (std::vector<int>{0, 1, 2}));
}

TEST(LegoLoam, GivesThePoseOfTheEndOfTheScan) {
  LegoLoamOptions options;
  EXPECT_NEAR(LegoLoam(options).register_scan(hall(7.0, 0)).stamp, 7.1, 1e-3);
  options.stamp_at_start = true;
  EXPECT_EQ(LegoLoam(options).register_scan(hall(7.0, 0)).stamp, 7.0);
  options = {};
  options.point_times = PointTimeSource::none;
  EXPECT_EQ(LegoLoam(options).register_scan(hall(7.0, 0)).stamp, 7.0);
}

TEST(LegoLoam, KeepsAKeyframeEveryThirtyCentimetres) {
  LegoLoamOptions options;
  options.point_times = PointTimeSource::none;  // each scan is taken at once
  options.mapping.every = 1;
  options.mapping.interval = 0;
  options.mapping.keyframes.density = 0.05;  // all of them are in the local map
  LegoLoam odometry(options);
  std::vector<int> keyframes;  // scans after which the local map has grown
  std::size_t last_size = 0;
  for (int i = 0; i <= 10; ++i) {
    const OdometryResult result = odometry.register_scan(hall(0.1 * i, 0.08 * i));
    EXPECT_NEAR(result.T_world_lidar.translation().x(), 0.08 * i, 0.02) << i;
    EXPECT_TRUE(result.alignment.converged) << i;
    if (odometry.local_map().size() > last_size) keyframes.push_back(i);
    last_size = odometry.local_map().size();
  }
  EXPECT_EQ(keyframes, (std::vector<int>{0, 4, 8}));
}

TEST(LegoLoam, SaysWhatItMadeOfTheScan) {
  const OdometryResult result = LegoLoam(LegoLoamOptions()).register_scan(hall(0, 0));
  EXPECT_EQ(result.counts.points_in, 16u * 1800u);
  EXPECT_EQ(result.counts.points_in - result.counts.outliers, result.filtered.size());
  EXPECT_GT(result.counts.edges, 8u);
  EXPECT_GT(result.counts.planes, 1000u);
  EXPECT_TRUE(result.alignment.converged);
}

TEST(LegoLoam, FollowsAPlaza) {
  const Simulator simulator("plaza", simulation_options("plaza", {{"seed", "7"}}));
  LegoLoam odometry{LegoLoamOptions()};
  Trajectory estimate, truth;
  for (std::size_t i = 80; i < 200; ++i) {
    const OdometryResult result = odometry.register_scan(simulator.scan(i).scan);
    estimate.push_back({result.stamp, result.T_world_lidar});
    truth.push_back({result.stamp, interpolate(simulator.truth(), result.stamp)});
  }
  EXPECT_GT(path_length(truth), 3.0);
  const Pose T_truth_world = truth.front().T_world_lidar * estimate.front().T_world_lidar.inverse();
  double squares = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Eigen::Vector3d found = T_truth_world * estimate[i].T_world_lidar.translation();
    squares += (found - truth[i].T_world_lidar.translation()).squaredNorm();
  }
  EXPECT_LT(std::sqrt(squares / double(truth.size())), 0.25);
}

}  // namespace
}  // namespace tilth
