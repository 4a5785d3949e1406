#include <random>

#include <gtest/gtest.h>

#include "search/neighbor_checks.hpp"
#include <tilth/search/kdtree.hpp>

namespace tilth {
namespace {

using Points = std::vector<Eigen::Vector3d>;

void expect_exact(const Points& points, const Eigen::Vector3d& query, std::size_t k) {
  const KdTree tree(points);
  std::vector<float> expected;
  for (const Eigen::Vector3d& p : points) expected.push_back(testing_search::squared_distance(query, p));
  std::sort(expected.begin(), expected.end());
  expected.resize(std::min(k, expected.size()));
  std::vector<Neighbor> found;
  tree.knn(query, k, found);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t j = 0; j < found.size(); ++j) {
    ASSERT_EQ(float(found[j].squared_distance), expected[j]);
    ASSERT_EQ(testing_search::squared_distance(query, points[found[j].index]), expected[j]);
  }
  const std::optional<Neighbor> nearest = tree.nearest(query);
  ASSERT_EQ(nearest.has_value(), !points.empty());
  if (nearest && k > 0) {
    ASSERT_EQ(float(nearest->squared_distance), expected[0]);
  }
}

TEST(KdTree, finds_what_a_look_at_all_points_finds) {
  std::mt19937 random(1);
  std::normal_distribution<double> spread(0.0, 3.0);
  const auto anywhere = [&] { return Eigen::Vector3d(spread(random), spread(random), spread(random)); };
  for (const std::size_t n : {1, 2, 10, 100, 1000}) {
    Points points(n);
    for (Eigen::Vector3d& p : points) p = anywhere();
    for (int i = 0; i < 50; ++i) expect_exact(points, i % 2 == 0 ? anywhere() : points[random() % n], random() % 30);
  }
}

TEST(KdTree, bears_duplicates_lines_and_nothing) {
  expect_exact({}, Eigen::Vector3d::Zero(), 3);
  expect_exact(Points(50, Eigen::Vector3d(1, 2, 3)), Eigen::Vector3d(1, 2, 3), 7);
  Points line, grid;
  for (int i = 0; i < 200; ++i) line.emplace_back(0.1 * i, 0.2 * i, -0.3 * i);
  for (int i = 0; i < 216; ++i) grid.emplace_back(i % 6, i / 6 % 6, i / 36);
  for (const std::size_t k : {0, 1, 5, 300}) {
    expect_exact(line, line[70], k);
    expect_exact(grid, grid[100], k);
  }
}

}  // namespace
}  // namespace tilth
