// Lines and planes of five neighbours against hand-made ones; which points find none; LOAM's weights.
#include <cmath>

#include <gtest/gtest.h>

#include <tilth/registration/line_plane_association.hpp>
#include <tilth/search/kdtree.hpp>

namespace tilth {
namespace {

const Eigen::Vector3d kOrigin = Eigen::Vector3d::Zero();

struct Target {
  explicit Target(std::vector<Eigen::Vector3d> p) : all(std::move(p)), tree(all) {}
  void knn(const Eigen::Vector3d& q, std::size_t k, std::vector<Neighbor>& out) const { tree.knn(q, k, out); }
  std::optional<Neighbor> nearest(const Eigen::Vector3d& q) const { return tree.nearest(q); }
  std::size_t size() const { return all.size(); }
  std::span<const Eigen::Vector3d> points() const { return all; }
  std::vector<Eigen::Vector3d> all;
  KdTree tree;
};

// A pole at (4, 1), a point every 0.1 m.
Target pole() {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 20; ++i) points.emplace_back(4, 1, 0.1 * i);
  return Target(points);
}

// A wall x = 3, a point every 0.2 m.
Target wall() {
  std::vector<Eigen::Vector3d> points;
  for (int i = -10; i <= 10; ++i) {
    for (int j = -5; j <= 5; ++j) points.emplace_back(3, 0.2 * i, 0.2 * j);
  }
  return Target(points);
}

// Five points of which the variance along x is `ratio` times that along y.
FitPoints cross_of(double ratio) {
  const double half = std::sqrt(ratio);
  return {{{5 + half, 0, 0}, {5 - half, 0, 0}, {5, 1, 0}, {5, -1, 0}, {5, 0, 0}}};
}

TEST(FitLine, TakesWhatIsMoreThanThreeTimesAsLongAsWide) {
  EXPECT_FALSE(fit_line(cross_of(2.99), 3.0));
  const std::optional<FittedLine> line = fit_line(cross_of(3.01), 3.0);
  ASSERT_TRUE(line);
  EXPECT_NEAR(std::abs(line->direction.x()), 1.0, 1e-12);
  EXPECT_LT((line->point - Eigen::Vector3d(5, 0, 0)).norm(), 1e-12);
}

TEST(FitPlane, TakesWhatIsFlatToTwentyCentimetres) {
  FitPoints points{{{3, 0, 0}, {3, 1, 0}, {3, 0, 1}, {3, 1, 1}, {3, 0.5, 0.5}}};
  const std::optional<FittedPlane> plane = fit_plane(points, kOrigin, 0.2);
  ASSERT_TRUE(plane);
  EXPECT_NEAR(std::abs(plane->normal.x()), 1.0, 1e-12);
  EXPECT_NEAR(plane->point.x(), 3.0, 1e-12);
  points[4].x() = 3.22;  // the fit gives way by a fifth of it
  EXPECT_TRUE(fit_plane(points, kOrigin, 0.2));
  points[4].x() = 3.3;
  EXPECT_FALSE(fit_plane(points, kOrigin, 0.2));
}

TEST(FitPlane, CannotGoThroughItsOrigin) {
  const FitPoints floor{{{5, 0, 0.01}, {5, 0.2, -0.01}, {5.2, 0, -0.01}, {5.2, 0.2, 0.01}, {5.1, 0.1, 0}}};
  const std::optional<FittedPlane> from_there = fit_plane(floor, kOrigin, 0.2);
  ASSERT_TRUE(from_there);
  EXPECT_LT(std::abs(from_there->normal.z()), 0.1);  // upright, where the floor is level
  const std::optional<FittedPlane> from_above = fit_plane(floor, {0, 0, 1}, 0.2);
  ASSERT_TRUE(from_above);
  EXPECT_GT(std::abs(from_above->normal.z()), 0.99);
  EXPECT_NEAR(from_above->normal.dot(from_above->point - floor[4]), 0, 1e-3);
}

TEST(LinePlaneAssociation, HoldsAnEdgePointAgainstItsPole) {
  const Target target = pole();
  const Pose T(Eigen::Translation3d(1, 0, 0));
  const std::vector<Eigen::Vector3d> edges{{3.1, 1.2, 0.93}};
  const std::vector<PointToLine> pairs = associate_lines(edges, T, target, LinePlaneOptions());
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_NEAR(pairs[0].residual(T).norm(), std::hypot(0.1, 0.2), 1e-9);
  EXPECT_NEAR(std::abs(pairs[0].direction.z()), 1.0, 1e-9);
}

TEST(LinePlaneAssociation, HoldsAPlanePointAgainstItsWall) {
  const Target target = wall();
  const std::vector<Eigen::Vector3d> planes{{2.7, 0.33, 0.1}};
  for (const bool from_sensor : {false, true}) {
    const LinePlaneOptions options{.planes_from_sensor = from_sensor};
    const std::vector<PointToPlane> pairs = associate_planes(planes, Pose::Identity(), target, options);
    ASSERT_EQ(pairs.size(), 1u);
    EXPECT_NEAR(std::abs(pairs[0].residual(Pose::Identity())[0]), 0.3, 1e-6);
  }
}

TEST(LinePlaneAssociation, RefusesAPointWhoseFifthNeighbourIsAMetreAway) {
  const Target target = pole();
  const std::vector<Eigen::Vector3d> edges{{4.95, 1, 1.0}, {5.0, 1, 1.0}};  // fifth at 0.97 and 1.02 m
  const std::vector<PointToLine> pairs = associate_lines(edges, Pose::Identity(), target, LinePlaneOptions());
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_EQ(pairs[0].source.x(), 4.95);
  const Target four({{4, 1, 0.9}, {4, 1, 1}, {4, 1, 1.1}, {4, 1, 1.2}});
  EXPECT_TRUE(associate_lines(edges, Pose::Identity(), four, LinePlaneOptions()).empty());
}

TEST(LinePlaneAssociation, WeighsByDistanceAsLoamDoes) {
  const LinePlaneOptions options{.max_distance = 3, .weight_slope = 0.9};
  const Pose I = Pose::Identity();
  const std::vector<Eigen::Vector3d> edges{{4.4, 1, 1}, {4.99, 1, 1}, {5.01, 1, 1}};
  const std::vector<PointToLine> lines = associate_lines(edges, I, pole(), options);
  ASSERT_EQ(lines.size(), 2u);  // 1 - 0.9 x 1.01 is below 0.1
  EXPECT_NEAR(lines[0].residual(I).norm(), 0.4 * (1 - 0.9 * 0.4), 1e-9);
  const std::vector<Eigen::Vector3d> planes{{2.4, 0.01, 0.02}, {1.0, 0.01, 0.02}};
  const std::vector<PointToPlane> pairs = associate_planes(planes, I, wall(), options);
  ASSERT_EQ(pairs.size(), 1u);  // 2 m off at a range of 1 m
  const double range = planes[0].norm();
  EXPECT_NEAR(std::abs(pairs[0].residual(I)[0]), 0.6 * (1 - 0.9 * 0.6 / std::sqrt(range)), 1e-6);
}

// As LeGO-LOAM does it, a pair 0.9 m from its wall has less say near the map's origin.
TEST(LinePlaneAssociation, MayTakeTheRangeFromTheOriginOfTheMap) {
  LinePlaneOptions options{.max_distance = 3, .weight_slope = 0.9};
  const Pose T(Eigen::Translation3d(1.5, 0, 0));
  const std::vector<Eigen::Vector3d> planes{{0.6, 0.01, 0.02}};  // 2.1 m from the origin
  const double distance = 0.9;
  EXPECT_TRUE(associate_planes(planes, T, wall(), options).empty());  // 1 - 0.81 / sqrt(0.6) is below 0.1
  options.range_from_origin = true;
  const std::vector<PointToPlane> pairs = associate_planes(planes, T, wall(), options);
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_NEAR(std::abs(pairs[0].residual(T)[0]), distance * (1 - 0.9 * distance / std::sqrt(2.1)), 1e-4);
}

}  // namespace
}  // namespace tilth
