#include <random>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <tilth/localization/map_tracker.hpp>

namespace tilth {
namespace {

Matrix6d some_covariance(double scale) {
  Matrix6d root = Matrix6d::Random();
  return scale * scale * (root * root.transpose() + 0.1 * Matrix6d::Identity());
}

TEST(MapTracker, CorrectsAsTheProductOfTwoNormals) {
  const Matrix6d prior = some_covariance(0.01), measured = some_covariance(0.02);
  MapTracker tracker({}, Pose::Identity(), prior);
  Vector6d offset;
  offset << 0.002, -0.001, 0.003, 0.01, -0.02, 0.005;
  ASSERT_TRUE(tracker.correct(exp(offset), measured.inverse()));
  const Matrix6d expected = (prior.inverse() + measured.inverse()).inverse();
  EXPECT_LT((tracker.covariance() - expected).norm(), 1e-9 * expected.norm());
  const Vector6d mean = expected * measured.inverse() * offset;
  EXPECT_LT((log(tracker.T_map_lidar()) - mean).norm(), 1e-9);
}

TEST(MapTracker, HearsNothingAlongWhatIsNotDetermined) {
  MapTracker tracker({}, Pose::Identity(), 1e-2 * Matrix6d::Identity());
  Matrix6d information = 1e6 * Matrix6d::Identity();
  information(3, 3) = 0;  // along x
  Vector6d offset = Vector6d::Zero();
  offset[3] = 0.3, offset[4] = 0.01;
  ASSERT_TRUE(tracker.correct(exp(offset), information));
  EXPECT_NEAR(tracker.T_map_lidar().translation().x(), 0, 1e-9);
  EXPECT_NEAR(tracker.T_map_lidar().translation().y(), 0.01, 1e-5);
  EXPECT_NEAR(tracker.covariance()(3, 3), 1e-2, 1e-9);
}

TEST(MapTracker, RefusesWhatContradictsIt) {
  MapTracker tracker({}, Pose::Identity(), 1e-6 * Matrix6d::Identity());
  EXPECT_FALSE(tracker.correct(Pose(Eigen::Translation3d(0.5, 0, 0)), 1e6 * Matrix6d::Identity()));
  EXPECT_TRUE(tracker.T_map_lidar().isApprox(Pose::Identity()));
}

TEST(MapTracker, IsAsSureAsItSays) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  constexpr double kMeasured = 0.02, kStep = 0.1;
  const MapTrackerOptions options{.noise = 0.01, .turn_noise = 0.1, .covariance_scale = 0};
  double nees = 0;
  constexpr int kRuns = 400;
  for (int run = 0; run < kRuns; ++run) {
    const auto noise = [&](double sigma) {
      return Vector6d(sigma * Vector6d::NullaryExpr([&] { return normal(random); }));
    };
    Pose truth = Pose::Identity();
    MapTracker tracker(options, exp(noise(kMeasured)), kMeasured * kMeasured * Matrix6d::Identity());
    for (int i = 0; i < 20; ++i) {
      const Pose step(Eigen::Translation3d(kStep, 0, 0));
      Vector6d drift = noise(std::sqrt(kStep));
      drift.head<3>() *= 0.1 * std::numbers::pi / 180, drift.tail<3>() *= 0.01;
      truth = truth * step;
      tracker.move(step * exp(drift), Matrix6d::Zero());
      if (i % 5 == 0) tracker.correct(truth * exp(noise(kMeasured)), Matrix6d::Identity() / (kMeasured * kMeasured));
    }
    const Vector6d error = log(tracker.T_map_lidar().inverse() * truth);
    nees += error.dot(tracker.covariance().inverse() * error) / kRuns;
  }
  EXPECT_NEAR(nees, 6.0, 0.6);
}

}  // namespace
}  // namespace tilth
