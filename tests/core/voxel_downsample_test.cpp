// The centroid voxel grid against means worked out by hand.
#include <gtest/gtest.h>

#include <tilth/core/voxel_downsample.hpp>

namespace tilth {
namespace {

TEST(VoxelDownsample, GivesTheMeanOfEveryAttributeInACell) {
  PointCloud cloud;
  cloud.points = {{0.1, 0.1, 0.1}, {0.7, 0.1, 0.1}, {0.3, 0.3, 0.2}, {0.2, 0.2, 0.3}};
  cloud.intensities = {1, 9, 2, 6};
  cloud.times = {0.00f, 0.05f, 0.02f, 0.04f};
  cloud.rings = {3, 7, 4, 4};
  const PointCloud sparse = voxel_downsample(cloud, 0.5);
  ASSERT_EQ(sparse.size(), 2u);
  EXPECT_LT((sparse.points[0] - Eigen::Vector3d(0.2, 0.2, 0.2)).norm(), 1e-12);
  EXPECT_EQ(sparse.points[1], cloud.points[1]);
  EXPECT_EQ(sparse.intensities, (std::vector<float>{3, 9}));
  EXPECT_FLOAT_EQ(sparse.times[0], 0.02f);
  EXPECT_EQ(sparse.rings, (std::vector<std::uint16_t>{4, 7}));
}

TEST(VoxelDownsample, CountsCellsFromTheOriginToBothSides) {
  PointCloud cloud;
  cloud.points = {{0.01, 0, 0}, {-0.01, 0, 0}, {-0.39, 0, 0}, {-0.41, 0, 0}, {0.39, 0, 0}};
  const PointCloud sparse = voxel_downsample(cloud, 0.4);
  ASSERT_EQ(sparse.size(), 3u);
  EXPECT_DOUBLE_EQ(sparse.points[0].x(), 0.2);
  EXPECT_DOUBLE_EQ(sparse.points[1].x(), -0.2);
  EXPECT_DOUBLE_EQ(sparse.points[2].x(), -0.41);
  EXPECT_TRUE(sparse.intensities.empty() && sparse.times.empty() && sparse.rings.empty());
}

TEST(VoxelDownsample, HoldsCellsByTheHundredThousandApart) {
  PointCloud cloud;
  for (int i = 0; i < 200000; ++i) cloud.points.emplace_back(0.2 * (i % 500) + 0.1, 0.2 * (i / 500) - 19.9, 0.0);
  EXPECT_EQ(voxel_downsample(cloud, 0.2).size(), cloud.size());
  EXPECT_TRUE(voxel_downsample({}, 0.2).empty());
}

}  // namespace
}  // namespace tilth
