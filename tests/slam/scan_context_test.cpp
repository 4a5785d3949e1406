// A place looks the same whatever the heading, and unlike others.
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include <tilth/core/se3.hpp>
#include <tilth/slam/scan_context.hpp>

namespace tilth {
namespace {

/// Upright things of many heights strewn about the sensor.
PointCloud place(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> ratio(0, 1);
  PointCloud cloud;
  for (int i = 0; i < 150; ++i) {
    const double range = 2 + 40 * ratio(random), azimuth = 2 * std::numbers::pi * ratio(random);
    const double top = 4 * ratio(random);
    for (double z = -1; z < top; z += 0.2)
      cloud.points.emplace_back(range * std::cos(azimuth), range * std::sin(azimuth), z);
  }
  return cloud;
}

PointCloud turned(const PointCloud& cloud, double yaw) {
  return transform(cloud, Pose(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ())));
}

TEST(ScanContext, TurningShiftsTheDescriptorAndNothingElse) {
  const ScanContextOptions options;
  const PointCloud cloud = place(1);
  const ScanContext candidate = describe_place(cloud, options);
  const double sector = 2 * std::numbers::pi / options.sectors;
  for (const int sectors : {0, 1, 7, 15, 30, 44, 59}) {
    // The query's frame is turned by yaw, so its points are turned back.
    const ScanContext query = describe_place(turned(cloud, -sectors * sector), options);
    EXPECT_TRUE(query.ring_key.isApprox(candidate.ring_key, 0.05F)) << sectors;
    const ContextMatch match = compare(query, candidate);
    EXPECT_LT(match.distance, 0.02) << sectors;
    const double yaw = sectors > 30 ? (sectors - 60) * sector : sectors * sector;
    EXPECT_NEAR(match.yaw, yaw, 1e-9) << sectors;
  }
}

TEST(ScanContext, FindsAHeadingBetweenSectorsToHalfASector) {
  const ScanContextOptions options;
  const PointCloud cloud = place(2);
  const ScanContext candidate = describe_place(cloud, options);
  for (const double yaw : {0.31, -1.234, 3.0, 2.05}) {
    const ContextMatch match = compare(describe_place(turned(cloud, -yaw), options), candidate);
    EXPECT_NEAR(match.yaw, yaw, 0.51 * 2 * std::numbers::pi / options.sectors) << yaw;
  }
}

TEST(ScanContext, OtherPlacesAreFarther) {
  const ScanContextOptions options;
  const ScanContext here = describe_place(place(1), options);
  const double again = compare(describe_place(turned(place(1), 2.0), options), here).distance;
  for (unsigned seed = 2; seed < 12; ++seed)
    EXPECT_GT(compare(describe_place(place(seed), options), here).distance, 1.5 * again) << seed;
}

TEST(ScanContext, NothingIsLikeNothing) {
  const ScanContextOptions options;
  const ScanContext empty = describe_place({}, options);
  EXPECT_EQ(compare(empty, empty).distance, 1.0);
  EXPECT_EQ(compare(describe_place(place(1), options), empty).distance, 1.0);
}

TEST(ScanContext, LeavesOutWhatIsTooNearTooFarOrTooLow) {
  const ScanContextOptions options;
  PointCloud cloud;
  cloud.points = {{0.5, 0, 0}, {100, 0, 0}, {5, 0, -10}};
  EXPECT_TRUE(describe_place(cloud, options).heights.isZero());
}

}  // namespace
}  // namespace tilth
