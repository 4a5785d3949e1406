// The method of Fu et al. as printed: how many features it takes, how its registration stops, and its readings.
#include <gtest/gtest.h>

#include <tilth/odometry/fu2026.hpp>
#include <tilth/odometry/make_odometry.hpp>
#include <tilth/simulation/simulator.hpp>

namespace tilth {
namespace {

const Simulator& corridor() {
  static const Simulator simulator("corridor", simulation_options("corridor", {{"seed", "101"}}));
  return simulator;
}

TEST(Fu2026, TakesAsManyFeaturesAsTheTextSays) {
  Fu2026 odometry{Fu2026Options()};
  for (std::size_t i = 0; i < 5; ++i) {
    const ScanCounts counts = odometry.register_scan(corridor().scan(10 + i).scan).counts;
    EXPECT_GE(counts.edges, 200u);
    EXPECT_LE(counts.edges, 300u);
    EXPECT_GE(counts.planes, 600u);
    EXPECT_LE(counts.planes, 900u);
  }
}

TEST(Fu2026, HasTheDefaultsOfTheText) {
  const Fu2026Options o;
  EXPECT_EQ(o.outliers.method, OutlierMethod::weighted);
  EXPECT_EQ(o.outliers.k, 10);
  EXPECT_EQ(o.outliers.alpha, 1.0);
  EXPECT_FALSE(o.outliers.per_range);
  EXPECT_EQ(o.outliers.ball, DensityBall::smallest);
  EXPECT_EQ(o.lambda, 1e-6);
  EXPECT_EQ(o.align.transformation_epsilon, 1e-6);
  EXPECT_EQ(o.align.fitness_epsilon, 1e-6);
  EXPECT_EQ(o.align.max_iterations, 200);
  EXPECT_EQ(o.align.kernel, Kernel::none);
  EXPECT_FALSE(o.predict);
}

TEST(Fu2026, EveryReadingKeepsASensorAtRestAtRest) {
  for (const std::string reading : {"inverse", "difference", "none"}) {
    for (const std::string neighborhood : {"scan", "features"}) {
      const auto odometry = make_odometry("fu2026", {{"outliers.density", reading}, {"neighborhood", neighborhood}});
      OdometryResult result;
      for (std::size_t i = 0; i < 6; ++i) result = odometry->register_scan(corridor().scan(10 + i).scan);
      EXPECT_TRUE(result.alignment.converged) << reading << ' ' << neighborhood;
      EXPECT_GT(result.alignment.matches, 500u);
      EXPECT_LT(result.T_world_lidar.translation().norm(), 0.1) << reading << ' ' << neighborhood;
    }
  }
}

// Two scans in motion, then scans of nothing, which leave the pose that the registration began with.
TEST(Fu2026, BeginsAtTheLastPoseUnlessToldToPredict) {
  for (const bool predict : {false, true}) {
    Fu2026Options options;
    options.predict = predict;
    Fu2026 odometry(options);
    Scan scan;
    for (std::size_t i = 0; i < 2; ++i) scan = corridor().scan(300 + i).scan, odometry.register_scan(scan);
    const Pose last = odometry.register_scan({scan.stamp + 0.1, {}}).T_world_lidar;
    const Pose then = odometry.register_scan({scan.stamp + 0.2, {}}).T_world_lidar;
    EXPECT_FALSE(last.isApprox(Pose::Identity(), 1e-6));
    EXPECT_EQ((last.inverse() * then).translation().norm() > 1e-6, predict);
  }
}

}  // namespace
}  // namespace tilth
