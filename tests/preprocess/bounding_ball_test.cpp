// The smallest ball against a search of all balls through two, three and four of the points.
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include <Eigen/QR>
#include <gtest/gtest.h>

#include <tilth/preprocess/bounding_ball.hpp>
#include <tilth/preprocess/outlier_removal.hpp>

namespace tilth {
namespace {

using Points = std::vector<Eigen::Vector3d>;

// The least squared radius of a ball through some of the points, numbered by the bits of a mask, that holds all.
double searched(const Points& points) {
  double least = std::numeric_limits<double>::infinity();
  for (unsigned mask = 1; mask < 1u << points.size(); ++mask) {
    Points through;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (mask >> i & 1) through.push_back(points[i]);
    }
    if (through.size() > 4) continue;
    Eigen::MatrixXd A(3, Eigen::Index(through.size()) - 1);
    for (std::size_t j = 1; j < through.size(); ++j) A.col(Eigen::Index(j) - 1) = through[j] - through[0];
    Eigen::Vector3d center = through[0];
    if (through.size() > 1) {
      const Eigen::VectorXd half = 0.5 * A.colwise().squaredNorm().transpose();
      center += A.transpose().completeOrthogonalDecomposition().solve(half);
    }
    double farthest = 0;
    for (const Eigen::Vector3d& p : points) farthest = std::max(farthest, (p - center).squaredNorm());
    least = std::min(least, farthest);
  }
  return least;
}

Points scattered(std::size_t n, const Eigen::Vector3d& extent, unsigned seed) {
  std::mt19937 rng(seed);
  std::uniform_real_distribution<double> u(-1, 1);
  Points points(n);
  for (Eigen::Vector3d& p : points)
    p = Eigen::Vector3d(7, -4, 1) + extent.cwiseProduct(Eigen::Vector3d(u(rng), u(rng), u(rng)));
  return points;
}

TEST(BoundingBall, IsTheSmallestOfAllThatHoldThePoints) {
  const Eigen::Vector3d blob(1, 1, 1), sheet(1, 1, 0), line(1, 0, 0), nearly_line(1, 1e-4, 1e-4);
  for (const Eigen::Vector3d& extent : {blob, sheet, line, nearly_line}) {
    for (unsigned seed = 0; seed < 20; ++seed) {
      const Points points = scattered(2 + seed % 8, extent, seed);
      const BoundingBall ball = bounding_ball(points);
      EXPECT_NEAR(ball.squared_radius, searched(points), 1e-7 * ball.squared_radius) << seed;
      for (const Eigen::Vector3d& p : points)
        EXPECT_LE((p - ball.center).squaredNorm(), ball.squared_radius * (1 + 1e-8)) << seed;
    }
  }
}

TEST(BoundingBall, HoldsPointsThatCoincideAndNothing) {
  EXPECT_LT(bounding_ball({}).squared_radius, 0);
  const BoundingBall ball = bounding_ball(Points(9, Eigen::Vector3d(1, 2, 3)));
  EXPECT_EQ(ball.squared_radius, 0);
  EXPECT_EQ(ball.center, Eigen::Vector3d(1, 2, 3));
}

// Five neighbours on one side of a point: the ball about it has twice the radius of theirs.
TEST(BoundingBall, MakesTheDensityOfNeighboursWhereverThePointIs) {
  PointCloud cloud;
  cloud.points = {{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {1, -1, 0}, {1, 0, 1}, {1, 0, -1}};
  NeighborTable table{.k = 5, .indices = {}, .squared_distances = {}};
  for (std::uint32_t i = 0; i < 6; ++i) {
    for (std::uint32_t j = 0; j < 6; ++j) {
      if (j != i) table.indices.push_back(j);
    }
  }
  std::vector<float> rho(6);
  bounding_ball_densities(cloud, table, {}, rho);
  EXPECT_NEAR(rho[0], 5 / (4.0 / 3 * std::numbers::pi), 1e-5);
  const std::vector<float> scale(6, 0.5f);
  bounding_ball_densities(cloud, table, scale, rho);
  EXPECT_NEAR(rho[0], 8 * 5 / (4.0 / 3 * std::numbers::pi), 1e-4);
}

// What docs/paper.md says of the two readings without bounds, on a sheet with strays.
TEST(BoundingBall, TheThresholdAsPrintedKeepsStraysByOneReadingAndDropsSurfaceByTheOther) {
  PointCloud cloud;
  cloud.points = scattered(3000, {0.002, 1, 1}, 3);
  const Points dense = scattered(3000, {0.0005, 0.1, 0.1}, 4), strays = scattered(30, {3, 3, 3}, 5);
  cloud.points.insert(cloud.points.end(), dense.begin(), dense.end());
  cloud.points.insert(cloud.points.end(), strays.begin(), strays.end());
  const NeighborTable table = scan_neighbors(cloud, 10);
  OutlierOptions options{.method = OutlierMethod::weighted, .density_min = -1e9, .density_max = 1e9};
  options.per_range = false, options.ball = DensityBall::smallest;
  const auto dropped = [&](DensityTerm reading, std::size_t begin, std::size_t end) {
    options.density = reading;
    const std::vector<std::uint8_t> keep = keep_inliers(cloud, table, options);
    return std::count(keep.begin() + std::ptrdiff_t(begin), keep.begin() + std::ptrdiff_t(end), 0);
  };
  EXPECT_EQ(dropped(DensityTerm::inverse, 6000, 6030), 0);
  EXPECT_GT(dropped(DensityTerm::difference, 6000, 6030), 20);
  EXPECT_GT(dropped(DensityTerm::difference, 3000, 6000), 300);
}

}  // namespace
}  // namespace tilth
