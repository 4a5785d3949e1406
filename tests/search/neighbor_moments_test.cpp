#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "search/generated_scans.hpp"
#include <tilth/core/error.hpp>
#include <tilth/search/neighbor_moments.hpp>

namespace tilth {
namespace {

Eigen::Matrix3d plain_covariance(const PointCloud& cloud, std::span<const std::uint32_t> neighbors,
                                 const std::vector<std::uint8_t>& keep) {
  std::vector<Eigen::Vector3d> kept;
  for (const std::uint32_t n : neighbors) {
    if (keep.empty() || keep[n] != 0) kept.push_back(cloud.points[n]);
  }
  if (kept.size() < 2) return Eigen::Matrix3d::Zero();
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : kept) mean += p / double(kept.size());
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : kept) sum += (p - mean) * (p - mean).transpose();
  return sum / double(kept.size() - 1);
}

void expect_moments(const PointCloud& cloud, std::size_t k, const std::vector<std::uint8_t>& keep) {
  const NeighborTable table = scan_neighbors(cloud, k);
  const LocalCovariances covariances = local_covariances(cloud, table, keep);
  ASSERT_EQ(covariances.size(), cloud.size());
  for (std::size_t i = 0; i < table.size(); ++i) {
    const Eigen::Matrix3d expected = plain_covariance(cloud, table.neighbors(i), keep);
    const double squared = table.distances(i).back(), rounding = 1e-6 * cloud.points[i].norm();
    const double bound = 3e-6 * squared + rounding * std::sqrt(squared) + rounding * rounding;
    ASSERT_LT((covariances.matrix(i).cast<double>() - expected).cwiseAbs().maxCoeff(), bound) << "point " << i;
    std::size_t count = 0;
    for (const std::uint32_t n : table.neighbors(i)) count += keep.empty() || keep[n] != 0;
    ASSERT_EQ(covariances.counts[i], count);
  }
}

TEST(LocalCovariances, equal_those_of_plain_sums) {
  const PointCloud room = generated::make_scan({.place = generated::kRoom, .columns = 203}, 3);
  for (const std::size_t k : {1, 2, 10, 25}) expect_moments(room, k, {});
}

TEST(LocalCovariances, leave_out_what_is_not_kept) {
  const PointCloud corridor = generated::make_scan({.place = generated::kCorridor, .columns = 203}, 4);
  std::mt19937 random(5);
  std::vector<std::uint8_t> keep(corridor.size());
  for (std::uint8_t& k : keep) k = random() % 4 != 0;
  expect_moments(corridor, 10, keep);
  expect_moments(corridor, 3, std::vector<std::uint8_t>(corridor.size(), 0));
}

TEST(LocalCovariances, of_few_points_and_of_none) {
  for (const std::size_t n : {0, 1, 2, 3, 9}) {
    PointCloud cloud;
    for (std::size_t i = 0; i < n; ++i) cloud.points.emplace_back(double(i), double(i * i), 1.0);
    expect_moments(cloud, 10, {});
  }
}

TEST(LocalCovariances, refuse_a_table_of_another_cloud) {
  const PointCloud cloud = generated::make_scan({.place = generated::kRoom, .columns = 20}, 1),
                   other = generated::make_scan({.place = generated::kRoom, .columns = 30}, 1);
  EXPECT_THROW(local_covariances(cloud, scan_neighbors(other, 5)), Error);
  const std::vector<std::uint8_t> keep(3, 1);
  EXPECT_THROW(local_covariances(cloud, scan_neighbors(cloud, 5), keep), Error);
}

}  // namespace
}  // namespace tilth
