// The firing tables against the makers' published figures.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <tilth/core/error.hpp>
#include <tilth/core/lidar_model.hpp>

namespace tilth {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// Elevations [deg] in the order in which the channels fire.
std::vector<double> as_they_fire(const LidarModel& lidar) {
  std::vector<std::pair<double, double>> channels;
  for (std::size_t r = 0; r < lidar.rings(); ++r) {
    channels.emplace_back(lidar.firing_offsets[r], lidar.elevations[r] / kDegree);
  }
  std::sort(channels.begin(), channels.end());
  std::vector<double> degrees;
  for (const auto& [offset, degree] : channels) degrees.push_back(degree);
  return degrees;
}

void expect_near(const std::vector<double>& values, const std::vector<double>& expected, double tolerance) {
  ASSERT_EQ(values.size(), expected.size());
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_NEAR(values[i], expected[i], tolerance) << "channel " << i;
}

TEST(LidarModel, SixteenBeamsFireInThePublishedOrder) {
  const std::vector<double> published{-15, 1, -13, 3, -11, 5, -9, 7, -7, 9, -5, 11, -3, 13, -1, 15};
  expect_near(as_they_fire(vlp16()), published, 1e-12);
  expect_near(as_they_fire(leishen_c16()), published, 1e-12);
}

TEST(LidarModel, Hdl32FiresInThePublishedOrder) {
  expect_near(as_they_fire(hdl32()), {-30.67, -9.33, -29.33, -8, -28, -6.67, -26.67, -5.33, -25.33, -4, -24, -2.67,
                                      -22.67, -1.33, -21.33, 0,  -20, 1.33,  -18.67, 2.67,  -17.33, 4,  -16, 5.33,
                                      -14.67, 6.67,  -13.33, 8,  -12, 9.33,  -10.67, 10.67},
              0.005);
}

TEST(LidarModel, Hdl64SpansThePublishedField) {
  const LidarModel lidar = hdl64();
  ASSERT_EQ(lidar.rings(), 64u);
  EXPECT_NEAR(lidar.elevations.front() / kDegree, -24.33, 0.01);
  EXPECT_NEAR(lidar.elevations[31] / kDegree, -8.83, 0.01);
  EXPECT_NEAR(lidar.elevations[32] / kDegree, -8.33, 0.01);
  EXPECT_NEAR(lidar.elevations.back() / kDegree, 2.0, 0.01);
}

TEST(LidarModel, FiresAtThePublishedTimes) {
  EXPECT_NEAR(vlp16().time_of(1, 0) - vlp16().time_of(0, 0), 55.296e-6, 1e-12);
  EXPECT_NEAR(vlp16().time_of(0, 15), 15 * 2.304e-6, 1e-12);  // +15 degrees is the last of a firing
  EXPECT_NEAR(vlp16().time_of(0, 8), 2.304e-6, 1e-12);        // +1 degree is the second
  EXPECT_NEAR(leishen_c16().time_of(2, 15), (2 * 16 + 15) * 3.125e-6, 1e-12);
  EXPECT_EQ(vlp16().columns, 1808u);
  EXPECT_EQ(leishen_c16().columns, 2000u);
  EXPECT_EQ(hdl32().columns, 2170u);
}

TEST(LidarModel, EveryFiringEndsBeforeTheNextAndWithinTheTurn) {
  for (const std::string_view name : lidar_names()) {
    const LidarModel lidar = make_lidar(name);
    for (std::size_t ring = 0; ring < lidar.rings(); ++ring) {
      EXPECT_LT(lidar.firing_offsets[ring], lidar.firing_period) << name;
      EXPECT_LE(lidar.time_of(lidar.columns - 1, ring), lidar.period) << name;
    }
  }
}

TEST(LidarModel, TurnsClockwiseFromStraightAhead) {
  const LidarModel lidar = vlp16();
  const Eigen::Vector3d ahead = lidar.direction(0, 0), later = lidar.direction(0, lidar.period / 4);
  EXPECT_NEAR(std::atan2(ahead.y(), ahead.x()), 0, 1e-12);
  EXPECT_NEAR(std::atan2(later.y(), later.x()), -std::numbers::pi / 2, 1e-12);
  EXPECT_NEAR(std::asin(later.z()), -15 * kDegree, 1e-12);
}

TEST(LidarModel, FindsTheNearestRing) {
  const LidarModel lidar = vlp16();
  for (std::size_t ring = 0; ring < lidar.rings(); ++ring) {
    EXPECT_EQ(lidar.ring_of(lidar.elevations[ring] + 0.4 * kDegree), ring);
    EXPECT_EQ(lidar.ring_of(lidar.elevations[ring] - 0.4 * kDegree), ring);
  }
  EXPECT_EQ(lidar.ring_of(-1.0), 0u);
  EXPECT_EQ(lidar.ring_of(1.0), 15u);
}

TEST(LidarModel, RefusesUnknownNamesAndTooManyColumns) {
  EXPECT_THROW(make_lidar("vlp17"), Error);
  EXPECT_THROW(with_columns(vlp16(), 0), Error);
  EXPECT_THROW(with_columns(vlp16(), 5000), Error);
  EXPECT_NEAR(with_columns(vlp16(), 1800).firing_period, 0.1 / 1800, 1e-15);
}

}  // namespace
}  // namespace tilth
