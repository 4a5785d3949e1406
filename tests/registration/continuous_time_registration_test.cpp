// Pose and velocity from patches of made rooms seen in motion; steps against numeric derivatives.
#include <random>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "made_places.hpp"

namespace tilth {
namespace {

TEST(ContinuousTimeRegistration, FindsPoseAndVelocityTogether) {
  for (const double ratio : {0.0, 0.3, 1.0}) {
    const SurfacePatches patches = seen(room(), kTruth, kVelocity, 600);
    const auto result =
        align_continuous_time(patches, kMiddle, prior_of(kVelocity, ratio * kSurprise), room(), kOptions);
    EXPECT_TRUE(result.pose.converged);
    EXPECT_EQ(result.pose.degenerate_directions, 0);
    EXPECT_EQ(result.pose.matches, patches.size());
    EXPECT_LT(pose_error(result), 2e-4);
    EXPECT_LT((result.motion.velocity - kVelocity).norm(), 5e-3);
  }
}

TEST(ContinuousTimeRegistration, NeedsNoMotionPriorBesidesTheLastPose) {
  MotionPrior prior{.T_map_last = kTruth * exp(-kVelocity * kPeriod), .interval = kPeriod};
  const auto result = align_continuous_time(seen(room(), kTruth, kVelocity, 600), kMiddle, prior, room(), kOptions);
  EXPECT_TRUE(result.pose.converged);
  EXPECT_LT(pose_error(result), 2e-4);
  EXPECT_LT((result.motion.velocity - kVelocity).norm(), 5e-3);
}

TEST(ContinuousTimeRegistration, AThirdOfWrongPatchesIsOutvoted) {
  SurfacePatches patches = seen(room(), kTruth, kVelocity, 900);
  std::mt19937 rng(8);
  std::uniform_real_distribution<double> off(0.2, 1.0);
  for (std::size_t i = 0; i < patches.size(); ++i) {
    if (i % 10 < 3) patches[i].mean += off(rng) * patches[i].normal;  // people before the walls
  }
  const auto result = align_continuous_time(patches, kMiddle, prior_of(kVelocity, 0.3 * kSurprise), room(), kOptions);
  EXPECT_TRUE(result.pose.converged);
  EXPECT_LT(pose_error(result), 5e-3);
  EXPECT_LT((result.motion.velocity - kVelocity).norm(), 0.05);
  ContinuousTimeOptions trusting = kOptions;
  trusting.first_kernel_width = trusting.kernel_width = 1e6;
  EXPECT_GT(pose_error(align_continuous_time(patches, kMiddle, prior_of(kVelocity, 0.3 * kSurprise), room(), trusting)),
            0.02);
}

TEST(ContinuousTimeRegistration, TooFewPairsKeepThePrediction) {
  const MotionPrior prior = prior_of(kVelocity, kSurprise);
  const Pose T_predicted = prior.T_map_last * exp(prior.velocity * prior.interval);
  SurfacePatches facing_nothing = seen(room(), kTruth, kVelocity, 100);
  for (SurfacePatch& patch : facing_nothing)
    patch.normal = kTruth.linear().transpose() * Eigen::Vector3d(1, 1, 1).normalized();
  const std::pair<SurfacePatches, Place> cases[] = {{seen(room(), kTruth, kVelocity, 19), room()},
                                                    {seen(room(), kTruth, kVelocity, 100), Place()},
                                                    {facing_nothing, room()},
                                                    {{}, room()}};
  for (const auto& [patches, place] : cases) {
    const auto result = align_continuous_time(patches, kMiddle, prior, place, kOptions);
    EXPECT_FALSE(result.pose.converged);
    EXPECT_LT(result.pose.matches, 20u);
    EXPECT_LT(log(T_predicted.inverse() * result.pose.T_target_source).norm(), 1e-9);
    EXPECT_EQ(result.motion.velocity, prior.velocity);
    EXPECT_TRUE((result.pose.covariance.diagonal().array() > 0).all());
  }
}

TEST(ContinuousTimeRegistration, AlongABareTunnelItGoesAsExpectedAndSaysSo) {
  const Pose T_map_middle = exp((Vector6d() << 0, 0, 0, 2, 0.3, -0.2).finished());
  const Vector6d velocity = (Vector6d() << 0, 0, 0, 1.5, 0, 0).finished();
  const SurfacePatches patches = seen(tunnel(), T_map_middle, velocity, 600);
  for (const bool known : {true, false}) {
    MotionPrior prior{.T_map_last = T_map_middle * exp(-velocity * kPeriod),
                      .velocity = velocity,
                      .last_motion = velocity,
                      .interval = kPeriod,
                      .known = known};
    prior.velocity[3] += 0.2;  // what was expected along the tunnel cannot be contradicted
    prior.velocity[4] += 0.2;  // across it can
    prior.last_motion[3] += 0.2;
    prior.steady_velocity = prior.velocity;
    const auto result = align_continuous_time(patches, kMiddle, prior, tunnel(), kOptions);
    const Eigen::Vector3d p = result.pose.T_target_source.translation();
    EXPECT_EQ(result.pose.degenerate_directions, 1);
    EXPECT_NEAR(p.x(), 2.02, 1e-3) << known;
    EXPECT_NEAR(p.y(), 0.3, 2e-4);
    EXPECT_LT(angle_of(result.pose.T_target_source), 2e-4);
    EXPECT_NEAR(result.motion.velocity[4], 0, 5e-3);
    EXPECT_GT(result.pose.covariance(3, 3), 100 * result.pose.covariance(4, 4));
  }
}

TEST(ContinuousTimeRegistration, WorksWithoutTimes) {
  SurfacePatches patches = seen(room(), kTruth, Vector6d::Zero(), 600);
  for (SurfacePatch& patch : patches) patch.time = 0;
  const auto result = align_continuous_time(patches, 0.0, prior_of(kVelocity, kSurprise), room(), kOptions);
  EXPECT_TRUE(result.pose.converged);
  EXPECT_LT(pose_error(result), 2e-4);
  EXPECT_LT((result.motion.velocity - kVelocity).norm(), 5e-3);  // that of the motion since the last pose
}

using Vector12d = Eigen::Matrix<double, 12, 1>;

/// A pair as the numeric derivative sees it: where its point is in the map, and the information of its offset there.
struct SeenPair {
  Eigen::Vector3d mean, offset;  // of the patch in the LiDAR's frame when it was seen; from the surface, in the map
  double lever;
  Eigen::Matrix3d information;
};

Eigen::Vector3d point_in_map(const SeenPair& pair, const MotionState& state, const Vector12d& x) {
  const Vector6d velocity = state.motion.velocity + x.tail<6>();
  return state.T_map_lidar * exp(x.head<6>()) * (exp(velocity * pair.lever) * pair.mean);
}

/// 1/2 the squared residual of a pair in units of its variance, its patch moved by `x` from `state`.
double half_square(const SeenPair& pair, const MotionState& state, const Vector12d& x) {
  const Eigen::Vector3d offset =
      pair.offset + point_in_map(pair, state, x) - point_in_map(pair, state, Vector12d::Zero());
  return 0.5 * offset.dot(pair.information * offset);
}

// Where the pairs alone speak, a step is -H^-1 g: g the gradient of the robust cost, H = J^T W J, both by differences.
TEST(ContinuousTimeRegistration, AStepIsGaussNewtonsOnTheRobustCost) {
  ContinuousTimeOptions free = kOptions;
  free.velocity_slack = 1e9;  // the prior says nothing
  const double width = 3;
  const MotionState state{kTruth, {}, kMiddle};  // the derivative by the velocity is exact at rest
  const SurfacePatches patches = seen(room(), kTruth, Vector6d::Zero(), 120);
  std::mt19937 rng(2);
  std::normal_distribution<double> noise(0, 0.03);
  PatchPairs pairs;
  std::vector<SeenPair> seen_pairs;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const SurfacePatch& patch = patches[i];
    const double lever = double(patch.time) - kMiddle;
    const double a = noise(rng), b = noise(rng), c = noise(rng);
    const Eigen::Vector3d offset(a, b, c), n = kTruth.linear() * patch.normal;
    const Eigen::Matrix3d joint = thin(n, 1e-2, 4e-4);
    if (i % 3 == 0) {
      pairs.shapes.push_back({patch.mean, offset, joint, lever});
      seen_pairs.push_back({patch.mean, offset, lever, joint.inverse()});
    } else {
      pairs.flat.push_back({patch.mean, patch.normal, n.dot(offset), 1 / 4e-4, lever});
      seen_pairs.push_back({patch.mean, offset, lever, n * n.transpose() / 4e-4});
    }
  }
  Vector12d gradient = Vector12d::Zero();
  Eigen::Matrix<double, 12, 12> H = Eigen::Matrix<double, 12, 12>::Zero();
  const double h = 1e-4;
  for (const SeenPair& pair : seen_pairs) {
    Vector12d g;
    const auto cost = [&](const Vector12d& x) { return half_square(pair, state, x); };
    for (int i = 0; i < 12; ++i) g[i] = (cost(h * Vector12d::Unit(i)) - cost(-h * Vector12d::Unit(i))) / (2 * h);
    const double squared = 2 * cost(Vector12d::Zero());
    const auto robust = [&](double s) { return s / (1 + s / (width * width)); };
    const double weight = (robust(squared + h) - robust(squared - h)) / (2 * h);
    gradient += weight * g;
    Eigen::Matrix<double, 3, 12> J;  // of the point in the map
    for (int i = 0; i < 12; ++i) {
      const auto point = [&](double step) { return point_in_map(pair, state, step * Vector12d::Unit(i)); };
      J.col(i) = (point(h) - point(-h)) / (2 * h);
    }
    H += weight * J.transpose() * pair.information * J;
  }
  const Vector12d expected = -H.ldlt().solve(gradient);

  MotionState after = state;
  after.kernel_width = width;
  ContinuousTimeAlignment result;
  ASSERT_TRUE(gauss_newton_step(pairs, {{.T_map_last = kTruth, .interval = kPeriod}}, free, after, result));
  Vector12d step;
  step << log(kTruth.inverse() * after.T_map_lidar), after.motion.velocity;
  EXPECT_LT((step - expected).norm(), 1e-4 * expected.norm());
  EXPECT_LT((result.pose.information - H.topLeftCorner<6, 6>()).norm(), 1e-5 * H.norm());
}

}  // namespace
}  // namespace tilth
