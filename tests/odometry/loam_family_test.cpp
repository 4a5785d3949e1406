// FLOAM and LIO-SAM in a made-up room: the schedule of iterations, keyframes, the stamp of the pose, and a rotation
// that stays one.
#include <features/cast_scans.hpp>

#include <gtest/gtest.h>

#include <tilth/odometry/floam.hpp>
#include <tilth/odometry/lio_sam.hpp>

namespace tilth {
namespace {

// A room of 7 x 9 x 3 m as it looks from T_room_lidar.
Scan room_scan(const Pose& T_room_lidar, double stamp, int columns) {
  using Eigen::Vector3d;
  const std::vector<std::pair<Vector3d, double>> walls{{{-1, 0, 0}, 3}, {{1, 0, 0}, 4}, {{0, -1, 0}, 5},
                                                       {{0, 1, 0}, 4},  {{0, 0, 1}, 1}, {{0, 0, -1}, 2}};
  cast::Surfaces surfaces;
  for (const auto& [normal, distance] : walls)
    surfaces.push_back(
        cast::plane(T_room_lidar.linear().transpose() * normal, distance + normal.dot(T_room_lidar.translation())));
  return {stamp, cast::scan(surfaces, {.noise = 0.01, .columns = columns})};
}

Pose turned(double degrees, double x = 0) {
  Pose T(Eigen::AngleAxisd(degrees * cast::kDegree, Eigen::Vector3d::UnitZ()));
  T.translation().x() = x;
  return T;
}

// The original's quaternion, multiplied up without normalisation, grows by 1 + sqrt 2 a scan at such a heading.
TEST(Floam, RotationStaysOneForFourHundredScansAtAHeadingOf120Degrees) {
  Floam floam{FloamOptions()};
  for (int i = 0; i < 440; ++i) {
    const OdometryResult result = floam.register_scan(room_scan(turned(std::min(3.0 * i, 120.0)), 0.1 * i, 240));
    const Eigen::Matrix3d R = result.T_world_lidar.linear();
    ASSERT_LT((R.transpose() * R - Eigen::Matrix3d::Identity()).norm(), 1e-12) << i;
    ASSERT_NEAR(Eigen::Quaterniond(R).norm(), 1.0, 1e-12) << i;
    if (i >= 40) {
      ASSERT_LT(angle_of(turned(120).inverse() * result.T_world_lidar), 3 * cast::kDegree) << i;
    }
  }
}

TEST(Floam, AssociatesElevenTimesThenOneLessEachScanDownToTwo) {
  FloamOptions options;
  options.align.transformation_epsilon = options.align.rotation_epsilon = options.align.fitness_epsilon = 0;
  Floam floam(options);
  for (int i = 0; i < 14; ++i) {
    const OdometryResult result = floam.register_scan(room_scan(turned(0, 0.05 * i), 0.1 * i, 400));
    const int scheduled = i == 0 ? 0 : std::max(12 - i, 2);
    EXPECT_LE(result.alignment.iterations, scheduled) << i;
    EXPECT_GE(result.alignment.iterations, scheduled - 2) << i << ": not even the last bits may move at the end";
    EXPECT_TRUE(result.alignment.converged);
  }
}

TEST(Floam, StampsThePoseWithTheInstantAskedFor) {
  const Scan scan = room_scan(turned(0), 7.0, 400);
  const double last = duration(scan.cloud);
  EXPECT_NEAR(Floam(FloamOptions()).register_scan(scan).stamp, 7 + 0.5 * last, 1e-9);
  FloamOptions as_the_original;
  as_the_original.pose_at = 0;
  EXPECT_EQ(Floam(as_the_original).register_scan(scan).stamp, 7.0);
}

TEST(LioSam, FollowsAMovingSensorAndStopsWhenThePoseStandsStill) {
  LioSam lio_sam{LioSamOptions()};
  for (int i = 0; i < 30; ++i) {
    const Pose T = turned(1.5 * i, 0.04 * i);
    const OdometryResult result = lio_sam.register_scan(room_scan(T, 0.1 * i, 900));
    EXPECT_LE(result.alignment.iterations, 30);
    EXPECT_TRUE(result.alignment.converged) << i;
    EXPECT_LT((T.translation() - result.T_world_lidar.translation()).norm(), 0.1) << i;
  }
}

TEST(LioSam, RegistersEverySecondScanAtTheOriginalsInterval) {
  LioSamOptions options;
  options.mapping_interval = 0.15;
  LioSam lio_sam(options);
  for (int i = 0; i < 6; ++i) {
    const OdometryResult result = lio_sam.register_scan(room_scan(turned(0), 0.1 * i, 600));
    EXPECT_EQ(result.alignment.converged, i % 2 == 0) << i;
    EXPECT_EQ(result.alignment.matches > 0, i > 0 && i % 2 == 0) << i;
  }
}

}  // namespace
}  // namespace tilth
