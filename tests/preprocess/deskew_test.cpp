// Scans in motion, straightened.
#include <gtest/gtest.h>

#include <tilth/preprocess/deskew.hpp>

namespace tilth {
namespace {

TEST(Deskew, PutsAWallSeenInMotionBackInOnePlace) {
  const Vector6d velocity = (Vector6d() << 0.1, -0.2, 1.5, 2.0, 0.3, -0.1).finished();
  const Eigen::Vector3d fixed(4, 1, 0.5);  // in the LiDAR's frame at t = 0.05
  const Eigen::Matrix3d covariance = Eigen::Vector3d(4, 2, 1).asDiagonal();
  SurfacePatches patches;
  for (int i = 0; i <= 10; ++i) {
    const double t = 0.0099 * i;
    const Pose T = exp(velocity * (t - 0.05)).inverse();
    patches.push_back({.mean = T * fixed,
                       .covariance = T.linear() * covariance * T.linear().transpose(),
                       .normal = T.linear() * Eigen::Vector3d::UnitX(),
                       .time = float(t)});
  }
  for (const SurfacePatch& patch : deskew(patches, {velocity}, 0.05)) {
    EXPECT_LT((patch.mean - fixed).norm(), 1e-5);
    EXPECT_LT((patch.normal - Eigen::Vector3d::UnitX()).norm(), 1e-5);
    EXPECT_LT((patch.covariance - covariance).norm(), 1e-4);
  }
  for (SurfacePatch& patch : patches) patch.time = 0;  // no times
  EXPECT_EQ(deskew(patches, {velocity}, 0.05)[3].mean, patches[3].mean);
}

// At 20 m, of a sensor that shakes by milliradians.
TEST(Deskew, MovesPatchesAndPointsAlikeWhateverIsLeftOfTheScan) {
  MotionInScan motion = MotionInScan::steady((Vector6d() << 0, 0, 0.5, 1, 0, 0).finished(), 0.05);
  for (std::size_t i = 0; i < motion.vibration.knots.size(); ++i)
    motion.vibration.knots[i][0] = (i % 2 == 0 ? 3e-3 : -3e-3);
  const Eigen::Vector3d point(0, 20, 1);
  const std::vector<float> times{0.01f, 0.031f, 0.055f, 0.075f};  // the last quarter of the turn is missing
  SurfacePatches patches;
  PointCloud cloud;
  for (const float time : times) {
    patches.push_back({.mean = point, .time = time});
    cloud.points.push_back(point);
    cloud.times.push_back(time);
  }
  cloud.points.push_back(point);
  cloud.times.push_back(0.1f);
  patches = deskew(patches, motion, 0.05);
  cloud = deskew(cloud, motion, 0.05);
  for (std::size_t i = 0; i < times.size(); ++i) {
    EXPECT_LT((patches[i].mean - cloud.points[i]).norm(), 1e-9) << times[i];
    EXPECT_LT((patches[i].mean - motion.at(double(times[i]) - 0.05) * point).norm(), 0.01) << times[i];
  }
}

TEST(Deskew, UndoesAVibrationWhereNothingElseMoves) {
  MotionInScan motion = MotionInScan::steady(Vector6d::Zero(), 0.05);
  motion.vibration.knots[2] = Vector6d::Constant(1e-3);
  PointCloud cloud;
  cloud.points.push_back({5, 1, 0});
  cloud.times.push_back(0.025f);
  EXPECT_LT((deskew(cloud, motion, 0.05).points[0] - exp(Vector6d::Constant(1e-3)) * cloud.points[0]).norm(), 1e-6);
}

}  // namespace
}  // namespace tilth
