// Times from azimuths, against a head that turns once in 0.1 s.
#include <cmath>

#include <gtest/gtest.h>

#include <tilth/preprocess/azimuth_times.hpp>

namespace tilth {
namespace {

// `points` firings of a clockwise turn that begins at `start` [rad, clockwise] and goes on over `span` [rad].
PointCloud turn(double start, double span, int points) {
  PointCloud cloud;
  for (int i = 0; i < points; ++i) {
    const double a = start + span * i / (points - 1);
    cloud.points.push_back({4 * std::cos(a), -4 * std::sin(a), 0.3});
  }
  return cloud;
}

TEST(AzimuthTimes, GrowEvenlyFromWhereverTheScanBegins) {
  for (const double start : {-3.1, -1.0, 0.0, 0.7, 3.0}) {
    for (const double span : {6.2, 5.0, 3.3}) {
      const std::vector<float> times = azimuth_times(turn(start, span, 301), 0.1);
      for (int i = 0; i <= 300; ++i) EXPECT_NEAR(times[std::size_t(i)], 0.1 * i / 300, 1e-6) << start << " " << span;
    }
  }
}

TEST(AzimuthTimes, AreThoseOfTheRingWhateverTheOrder) {
  PointCloud cloud = turn(0.0, 6.2, 301);
  std::swap(cloud.points[10], cloud.points[200]);
  const std::vector<float> times = azimuth_times(cloud, 0.1);
  EXPECT_NEAR(times[10], 0.1 * 200 / 300, 1e-6);
  EXPECT_TRUE(azimuth_times({}, 0.1).empty());
}

}  // namespace
}  // namespace tilth
