// What every table of neighbours must fulfil, and the plain search that says so.
#pragma once

#include <algorithm>
#include <cstddef>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include <tilth/core/point_cloud.hpp>
#include <tilth/search/kdtree.hpp>
#include <tilth/search/scan_neighbors.hpp>

namespace tilth::testing_search {

inline float squared_distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const float dx = float(a.x()) - float(b.x()), dy = float(a.y()) - float(b.y()), dz = float(a.z()) - float(b.z());
  return (dx * dx + dy * dy) + dz * dz;
}

/// The k least squared distances from point i to the others, by looking at them all.
inline std::vector<float> plain_distances(const PointCloud& cloud, std::size_t i, std::size_t k) {
  std::vector<float> all;
  for (std::size_t j = 0; j < cloud.size(); ++j) {
    if (j != i) all.push_back(squared_distance(cloud.points[i], cloud.points[j]));
  }
  std::partial_sort(all.begin(), all.begin() + std::ptrdiff_t(k), all.end());
  all.resize(k);
  return all;
}

/// As plain_distances(), by a kd-tree.
inline std::vector<float> tree_distances(const PointCloud& cloud, const KdTree& tree, std::size_t i, std::size_t k) {
  std::vector<Neighbor> found;
  tree.knn(cloud.points[i], k + 1, found);
  std::vector<float> distances;
  for (const Neighbor& n : found) distances.push_back(float(n.squared_distance));
  distances.erase(distances.begin());  // itself or a duplicate of it, at distance zero
  return distances;
}

/// Row i holds k other points, none twice, at the distances that it says, nearest first.
inline ::testing::AssertionResult row_is_sound(const PointCloud& cloud, const NeighborTable& table, std::size_t i) {
  std::set<std::uint32_t> seen;
  for (std::size_t j = 0; j < table.k; ++j) {
    const std::uint32_t n = table.neighbors(i)[j];
    const float d = table.distances(i)[j];
    if (n >= cloud.size()) return ::testing::AssertionFailure() << "point " << i << ": no point " << n;
    if (n == i) return ::testing::AssertionFailure() << "point " << i << " is its own neighbour";
    if (!seen.insert(n).second)
      return ::testing::AssertionFailure() << "point " << i << ": neighbour " << n << " twice";
    if (d != squared_distance(cloud.points[i], cloud.points[n])) {
      return ::testing::AssertionFailure() << "point " << i << ": distance of neighbour " << n << " is wrong";
    }
    if (j > 0 && d < table.distances(i)[j - 1])
      return ::testing::AssertionFailure() << "point " << i << ": row not sorted";
  }
  return ::testing::AssertionSuccess();
}

inline ::testing::AssertionResult distances_equal(const NeighborTable& table, std::size_t i,
                                                  const std::vector<float>& expected) {
  const auto row = table.distances(i);
  if (std::equal(row.begin(), row.end(), expected.begin(), expected.end())) return ::testing::AssertionSuccess();
  ::testing::AssertionResult failure = ::testing::AssertionFailure();
  failure << "point " << i << ": squared distances";
  for (std::size_t j = 0; j < row.size(); ++j)
    failure << ' ' << row[j] << '(' << (j < expected.size() ? expected[j] : -1) << ')';
  return failure;
}

/// Checks every row of `table` against all pairs (small clouds) or a kd-tree.
inline void expect_exact(const PointCloud& cloud, const NeighborTable& table, std::size_t k) {
  constexpr std::size_t kSmall = 700;
  ASSERT_EQ(table.k, cloud.empty() ? 0 : std::min(k, cloud.size() - 1));
  ASSERT_EQ(table.indices.size(), cloud.size() * table.k);
  const KdTree tree(cloud.points);
  for (std::size_t i = 0; i < table.size(); ++i) {
    ASSERT_TRUE(row_is_sound(cloud, table, i));
    const bool small = cloud.size() <= kSmall;
    ASSERT_TRUE(distances_equal(table, i,
                                small ? plain_distances(cloud, i, table.k) : tree_distances(cloud, tree, i, table.k)));
  }
}

}  // namespace tilth::testing_search
