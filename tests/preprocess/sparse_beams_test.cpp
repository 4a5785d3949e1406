// Beams of a dense sensor, left out by their elevation.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <tilth/preprocess/sparse_beams.hpp>

namespace tilth {
namespace {

/// Rings at these elevations [deg], each seen in eight directions and at as many ranges.
PointCloud cloud_of(const std::vector<double>& elevations) {
  PointCloud cloud;
  for (std::size_t ring = 0; ring < elevations.size(); ++ring) {
    if (std::isnan(elevations[ring])) continue;
    const double elevation = elevations[ring] * std::numbers::pi / 180;
    for (int i = 0; i < 8; ++i) {
      const Eigen::AngleAxisd turn(i * std::numbers::pi / 4, Eigen::Vector3d::UnitZ());
      cloud.points.emplace_back(turn * Eigen::Vector3d(std::cos(elevation), 0, std::sin(elevation)) * (1.0 + i));
      cloud.rings.push_back(std::uint16_t(ring));
    }
  }
  return cloud;
}

TEST(SparseBeams, KeepsBeamsThatAreFarEnoughApart) {
  const PointCloud dense = cloud_of({-2.0, -1.5, -0.9, -0.4, 0.0, 0.9, 3.0});
  const PointCloud sparse = sparse_beams(dense, 1.0);
  ASSERT_EQ(sparse.size(), 4 * 8U);  // -2, -0.9, 0.9, 3
  EXPECT_EQ(sparse.points[8], dense.points[16]);
  for (std::size_t i = 0; i < sparse.size(); ++i) EXPECT_EQ(sparse.rings[i], i / 8);
}

TEST(SparseBeams, ASensorUpsideDownKeepsAsMany) {
  EXPECT_EQ(sparse_beams(cloud_of({3.0, 0.9, 0.0, -0.4, -0.9, -1.5, -2.0}), 1.0).size(), 4 * 8U);  // 3, 0.9, -0.4, -1.5
  EXPECT_EQ(sparse_beams(cloud_of({3.0, 1.0, -1.0, -3.0}), 1.9).size(), 4 * 8U);
}

TEST(SparseBeams, ASparseSensorStaysAsItIs) {
  const PointCloud cloud = cloud_of({-3.0, std::nan(""), 1.0, 3.0});
  const PointCloud same = sparse_beams(cloud, 1.9);
  EXPECT_EQ(same.points, cloud.points);
  EXPECT_EQ(same.rings, cloud.rings);
}

TEST(SparseBeams, WithoutRingsOrPointsNothingIsDone) {
  PointCloud bare = cloud_of({-1.0, 0.0, 1.0});
  bare.rings.clear();
  EXPECT_EQ(sparse_beams(bare, 5.0).size(), bare.size());
  EXPECT_TRUE(sparse_beams({}, 5.0).empty());
}

}  // namespace
}  // namespace tilth
