// Points put together with the truth of their own time give walls as thick as the noise of the ranges.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <tilth/simulation/mesh_world.hpp>
#include <tilth/simulation/motion.hpp>
#include <tilth/simulation/simulate_scan.hpp>

namespace tilth {
namespace {

constexpr double kNoise = 0.02;  // [m]
constexpr double kHalf = 6.0;    // [m] half the side of the square room
constexpr double kDegree = std::numbers::pi / 180;

Mesh square_room() {
  Mesh mesh;
  const SurfaceId wall = add_surface(mesh, {"wall"});
  const std::array<Eigen::Vector3d, 4> corners{Eigen::Vector3d(-kHalf, -kHalf, -20),
                                               Eigen::Vector3d(kHalf, -kHalf, -20), Eigen::Vector3d(kHalf, kHalf, -20),
                                               Eigen::Vector3d(-kHalf, kHalf, -20)};
  for (std::size_t i = 0; i < 4; ++i) add_wall(mesh, wall, {corners[i], corners[(i + 1) % 4], 40.0, {}});
  return mesh;
}

/// 2 m/s and up to 90 deg/s, to the left and to the right.
Trajectory fast_drive() {
  const std::vector<Leg> legs{{1, 1, 0}, {2, 2, 80 * kDegree}, {2, 2, -90 * kDegree}, {2, 1, 90 * kDegree}};
  MotionOptions options;
  options.seed = 7;
  return drive(legs, upright({-3, -3, 0}, 0), options);
}

/// Deviation [m] along the beam of every point from its wall: exact for a plane, whatever the angle it is seen at.
template <class PoseOf>
double thickness(const PoseOf& pose_of) {
  const MeshWorld world(square_room(), {});
  const Trajectory trajectory = fast_drive();
  NoiseOptions options;
  options.noise = kNoise;
  options.outliers = options.mixed = options.ghosts = options.grazing = options.glossy = 0;
  options.quantize = false;
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t k = 0; k < 60; ++k) {
    const LabelledScan made = simulate_scan(world, {vlp16()}, trajectory, options, {0.1 * double(k), 3, k});
    const PointCloud& cloud = made.scan.cloud;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const Pose T = pose_of(trajectory, made.scan.stamp, cloud.times[i]);
      const Eigen::Vector3d point = T * cloud.points[i], beam = (T.linear() * cloud.points[i]).normalized();
      const int axis = std::abs(point.x()) > std::abs(point.y()) ? 0 : 1;
      if (std::abs(std::abs(point.x()) - std::abs(point.y())) < 0.5) continue;  // a corner: which wall is open
      const double off = (std::abs(point[axis]) - kHalf) / std::abs(beam[axis]);
      sum += off * off, ++count;
    }
  }
  EXPECT_GT(count, 1000000u);
  return std::sqrt(sum / double(count));
}

TEST(WallThickness, IsTheRangeNoiseWithTheTruthOfEveryFiring) {
  const double rms = thickness(
      [](const Trajectory& trajectory, double stamp, double time) { return interpolate(trajectory, stamp + time); });
  EXPECT_NEAR(rms, kNoise, 0.02 * kNoise);
}

TEST(WallThickness, IsSeveralTimesThatWithOnePoseAScan) {
  const double rms =
      thickness([](const Trajectory& trajectory, double stamp, double) { return interpolate(trajectory, stamp); });
  EXPECT_GT(rms, 3 * kNoise);
}

}  // namespace
}  // namespace tilth
