// Two clouds registered to one another, against the truth of the simulator.
#include <gtest/gtest.h>

#include <tilth/odometry/align_clouds.hpp>
#include <tilth/simulation/simulator.hpp>

namespace tilth {
namespace {

/// Of the translation [m] and the rotation [rad] by which two scans, `steps` apart, are registered wrongly.
std::pair<double, double> error(std::string_view scene, std::size_t first, std::size_t steps) {
  const Simulator simulator(scene, simulation_options(scene, {{"seed", "7"}, {"snapshot", "true"}}));
  const Scan target = simulator.scan(first).scan, source = simulator.scan(first + steps).scan;
  const AlignResult result = align_clouds(source.cloud, target.cloud);
  EXPECT_TRUE(result.converged) << scene;
  EXPECT_GT(result.matches, result.candidates / 2) << scene;
  const Trajectory& truth = simulator.truth();
  const Pose T_target_source = interpolate(truth, target.stamp).inverse() * interpolate(truth, source.stamp);
  const Pose rest = T_target_source.inverse() * result.T_target_source;
  return {rest.translation().norm(), angle_of(rest)};
}

TEST(AlignClouds, FindsWhereTheSensorWent) {
  for (const char* scene : {"corridor", "plaza"}) {
    const auto [translation, rotation] = error(scene, 150, 5);  // half a second at a metre a second
    EXPECT_LT(translation, 0.03) << scene;
    EXPECT_LT(rotation, 0.005) << scene;
  }
}

TEST(AlignClouds, SaysWhereThereIsNothingToMatch) {
  const Pose T_init(Eigen::Translation3d(1, 2, 3));
  const AlignResult result = align_clouds({}, {}, T_init);
  EXPECT_FALSE(result.converged);
  EXPECT_TRUE(result.T_target_source.isApprox(T_init));
}

}  // namespace
}  // namespace tilth
