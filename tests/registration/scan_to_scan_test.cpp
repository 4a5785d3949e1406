// Scan to scan on a made world: level ground and upright poles, seen by a sensor that moves during the scan.
#include <gtest/gtest.h>

#include <tilth/registration/scan_to_scan.hpp>

namespace tilth {
namespace {

constexpr double kPeriod = 0.1;

void add(PointCloud& cloud, const Eigen::Vector3d& p, int row) {
  cloud.points.push_back(p);
  cloud.rings.push_back(std::uint16_t(row));
}

// Rows of ground at rising distances, 1 m below; every `step` degrees.
PointCloud ground(double step) {
  PointCloud cloud;
  for (int row = 0; row < 8; ++row) {
    for (double a = 0; a < 360; a += step) {
      const double r = 3 + 0.8 * row;
      add(cloud, {r * std::cos(a * M_PI / 180), r * std::sin(a * M_PI / 180), -1}, row);
    }
  }
  return cloud;
}

// Poles around the sensor, a point a row; rows are `rise` [m] apart, and `lift` [m] higher.
PointCloud poles(double rise, double lift) {
  PointCloud cloud;
  for (int row = 0; row < 16; ++row) {
    for (double a = 10; a < 360; a += 29)
      add(cloud, {(4 + a / 90) * std::cos(a * M_PI / 180), (4 + a / 90) * std::sin(a * M_PI / 180), rise * row + lift},
          row);
  }
  return cloud;
}

// The points, given at the start of a scan, as a sensor sees them that moves by T_start_end meanwhile.
PointCloud measured(PointCloud cloud, const Pose& T_start_end) {
  const Vector6d motion = log(T_start_end);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double ratio = double((37 * i) % 101) / 100;
    cloud.points[i] = exp(ratio * motion).inverse() * cloud.points[i];
    cloud.times.push_back(float(ratio * kPeriod));
  }
  return cloud;
}

// roll, pitch and yaw [rad]; x, y, z [m]
Pose motion(double roll, double pitch, double yaw, double x, double y, double z) {
  return exp((Vector6d() << roll, pitch, yaw, x, y, z).finished());
}

struct World {
  ScanTargets targets{ScanTarget(poles(0.1, -0.8)), ScanTarget(ground(1.0))};

  AlignResult align_to(const Pose& T_true, const ScanToScanOptions& options,
                       const Pose& T_init = Pose::Identity()) const {
    const PointCloud edges = measured(poles(0.1, -0.77), T_true), planes = measured(ground(7.3), T_true);
    return align_scan_to_scan({edges, planes, kPeriod}, targets, T_init, options);
  }
};

ScanToScanOptions whole_steps() {
  ScanToScanOptions options;
  options.ground_step.step_ratio = options.edge_step.step_ratio = 1;
  return options;
}

const Pose kMotion = motion(0.008, -0.006, 0.04, 0.12, -0.04, 0.015);
constexpr int kNever = 1000000000;

TEST(ScanToScan, RecoversTheMotionDuringTheScan) {
  const AlignResult result = World().align_to(kMotion, whole_steps());
  EXPECT_TRUE(result.converged);
  EXPECT_LT(log(result.T_target_source.inverse() * kMotion).norm(), 2e-3);
  EXPECT_EQ(result.candidates, result.matches);
  EXPECT_EQ(result.degenerate_directions, 0);
  EXPECT_GT(result.information.diagonal().minCoeff(), 10);
}

TEST(ScanToScan, TakesRollPitchAndZFromTheGroundAlone) {
  ScanToScanOptions options = whole_steps();
  options.edge_step.min_matches = kNever;
  const Vector6d found = log(World().align_to(kMotion, options).T_target_source), truth = log(kMotion);
  for (const int i : {0, 1, 5}) EXPECT_NEAR(found[i], truth[i], 1e-3) << i;
  for (const int i : {2, 3, 4}) EXPECT_NEAR(found[i], 0, 1e-4) << i;  // but for the order of rotations
}

TEST(ScanToScan, TakesYawXAndYFromEdgesAlone) {
  ScanToScanOptions options = whole_steps();
  options.ground_step.min_matches = kNever;
  const Vector6d found = log(World().align_to(kMotion, options).T_target_source), truth = log(kMotion);
  for (const int i : {2, 3, 4}) EXPECT_NEAR(found[i], truth[i], 4e-3) << i;
  for (const int i : {0, 1, 5}) EXPECT_EQ(found[i], 0) << i;
}

// The step of the original: 25 of 5 % close 72 % of an error, and none is taken after a true step below 2 cm.
TEST(ScanToScan, StopsFarFromTheOptimumAsTheOriginal) {
  ScanToScanOptions options;
  const auto z_found = [&](double z) {
    return World().align_to(motion(0, 0, 0, 0, 0, z), options).T_target_source.translation().z();
  };
  EXPECT_NEAR(z_found(0.019), 0.05 * 0.019, 1e-4);
  options.ground_step.transformation_epsilon = 0;
  EXPECT_NEAR(z_found(0.019), (1 - std::pow(0.95, 25)) * 0.019, 3e-4);
}

// Rails along x say nothing of x: it stays as it was predicted.
TEST(ScanToScan, HoldsWhatEdgesDoNotDetermine) {
  const auto rails = [](double shift) {
    PointCloud cloud;
    for (int row = 0; row < 4; ++row) {
      for (int i = -40; i <= 40; ++i) add(cloud, {0.1 * i + 0.03 * row + shift, row % 2 ? 3.0 : -3.0, 0.4}, row / 2);
    }
    return cloud;
  };
  const ScanTargets targets{ScanTarget(rails(0)), ScanTarget(ground(1.0))};
  const Pose T_true = motion(0, 0, 0, 0.2, 0.05, 0), T_init = motion(0, 0, 0, 0.11, 0, 0);
  const PointCloud edges = measured(rails(0.01), T_true), planes = measured(ground(7.3), T_true);
  const AlignResult result = align_scan_to_scan({edges, planes, kPeriod}, targets, T_init, whole_steps());
  EXPECT_NEAR(result.T_target_source.translation().x(), 0.11, 1e-3);
  EXPECT_NEAR(result.T_target_source.translation().y(), 0.05, 5e-3);
}

TEST(ScanToScan, KeepsThePredictionWithoutTenEdgesAndAHundredPlanes) {
  const auto first = [](const PointCloud& cloud, std::uint32_t n) {
    std::vector<std::uint32_t> indices(n);
    for (std::uint32_t i = 0; i < n; ++i) indices[i] = i;
    return select(cloud, indices);
  };
  const auto result_with = [&](std::uint32_t edges, std::uint32_t planes) {
    const World world{{ScanTarget(first(poles(0.1, 0), edges)), ScanTarget(first(ground(1.0), planes))}};
    return world.align_to(kMotion, {}, motion(0, 0, 0.01, 0, 0, 0));
  };
  EXPECT_TRUE(result_with(9, 2000).T_target_source.isApprox(motion(0, 0, 0.01, 0, 0, 0)));
  EXPECT_TRUE(result_with(100, 99).T_target_source.isApprox(motion(0, 0, 0.01, 0, 0, 0)));
  EXPECT_EQ(result_with(100, 99).iterations, 0);
  EXPECT_GT(result_with(100, 100).iterations, 0);
}

}  // namespace
}  // namespace tilth
