#include <gtest/gtest.h>

#include <tilth/core/error.hpp>
#include <tilth/core/parallel.hpp>
#include <tilth/core/point_cloud.hpp>
#include <tilth/core/trajectory.hpp>

namespace tilth {
namespace {

PointCloud two_points() {
  PointCloud cloud;
  cloud.points = {{1, 0, 0}, {0, 2, 0}};
  cloud.times = {0.0f, 0.1f};
  return cloud;
}

TEST(PointCloud, SelectKeepsOnlyTheAttributesThatExist) {
  const std::uint32_t second[] = {1};
  const PointCloud picked = select(two_points(), second);
  ASSERT_EQ(picked.size(), 1u);
  EXPECT_EQ(picked.points[0], Eigen::Vector3d(0, 2, 0));
  EXPECT_EQ(picked.times[0], 0.1f);
  EXPECT_TRUE(picked.rings.empty());
}

TEST(PointCloud, AppendDropsAnAttributeThatOneSideLacks) {
  PointCloud cloud;
  append(cloud, two_points());
  EXPECT_TRUE(cloud.has_times());
  PointCloud bare;
  bare.points = {{5, 5, 5}};
  append(cloud, bare);
  EXPECT_EQ(cloud.size(), 3u);
  EXPECT_TRUE(cloud.times.empty());
}

TEST(PointCloud, TransformMovesPoints) {
  const PointCloud cloud = two_points();
  Eigen::Isometry3d T(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ()));
  T.translation() = Eigen::Vector3d(0, 0, 1);
  const PointCloud moved = transform(cloud, T);
  EXPECT_LT((moved.points[0] - Eigen::Vector3d(0, 1, 1)).norm(), 1e-12);
}

TEST(Parallel, SumsAreOrderedAndLoopsCoverEveryIndexOnce) {
  std::vector<int> seen(10007, 0);
  parallel_for(seen.size(), 64, [&](std::size_t b, std::size_t e) {
    for (; b < e; ++b) ++seen[b];
  });
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), 10007);
  const auto sum = [] {
    return parallel_sum<double>(10007, 64, [](std::size_t b, std::size_t e) {
      double s = 0;
      for (; b < e; ++b) s += 1.0 / double(b + 1);
      return s;
    });
  };
  const double first = sum();
  for (int i = 0; i < 20; ++i) EXPECT_EQ(sum(), first);
  EXPECT_EQ(parallel_sum<int>(0, 8, [](std::size_t, std::size_t) { return 1; }), 0);
}

TEST(Trajectory, InterpolatesAndExtrapolates) {
  Trajectory trajectory(3);
  for (int i = 0; i < 3; ++i) trajectory[i] = {double(i), Pose(Eigen::Translation3d(2.0 * i, 0, 0))};
  EXPECT_NEAR(interpolate(trajectory, 0.25).translation().x(), 0.5, 1e-12);
  EXPECT_NEAR(interpolate(trajectory, 3.0).translation().x(), 6.0, 1e-12);
  EXPECT_NEAR(interpolate(trajectory, -1.0).translation().x(), -2.0, 1e-12);
  EXPECT_NEAR(path_length(trajectory), 4.0, 1e-12);
  EXPECT_THROW(interpolate(Trajectory{}, 0.0), Error);
}

}  // namespace
}  // namespace tilth
