// A scan is found in a map from far off.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <tilth/registration/pose_search.hpp>

namespace tilth {
namespace {

void add_wall(const Eigen::Vector2d& from, const Eigen::Vector2d& to, std::vector<FacingPoint>& points) {
  const Eigen::Vector2d along = (to - from).normalized();
  for (double s = 0; s < (to - from).norm(); s += 0.2) {
    const Eigen::Vector2d p = from + s * along;
    points.push_back({{p.x(), p.y(), 0.5}, {-along.y(), along.x(), 0}});
  }
}

/// An L of 20 m by 12 m, a pillar, and floor, of which the search sees nothing.
std::vector<FacingPoint> room() {
  const std::vector<Eigen::Vector2d> corners{{0, 0}, {20, 0}, {20, 7}, {11, 7}, {11, 12}, {0, 12}};
  std::vector<FacingPoint> points;
  for (std::size_t i = 0; i < corners.size(); ++i) add_wall(corners[i], corners[(i + 1) % corners.size()], points);
  add_wall({5, 4}, {5, 6}, points);
  add_wall({5, 6}, {6, 6}, points);
  for (double x = 0; x < 20; x += 0.5) points.push_back({{x, 3, -1}, {0, 0, 1}});
  return points;
}

std::vector<FacingPoint> seen_from(const Pose& T_map_lidar, const std::vector<FacingPoint>& in_map) {
  std::vector<FacingPoint> seen;
  for (const FacingPoint& p : in_map)
    seen.push_back({T_map_lidar.inverse() * p.point, T_map_lidar.linear().transpose() * p.normal});
  return seen;
}

Pose at(double x, double y, double yaw) {
  return Eigen::Translation3d(x, y, 0) * Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ());
}

TEST(PoseSearch, FindsAScanMetresAndManyDegreesAway) {
  const Pose T_start = at(4, 3, 0.2), T_true = at(7.3, 4.6, 1.1);
  const auto found = search_poses(room(), seen_from(T_true, room()), T_start, {5.0, 1.5}, {});
  ASSERT_FALSE(found.empty());
  const Pose error = T_true.inverse() * found.front().T_target_source;
  EXPECT_LT(error.translation().norm(), 0.5);
  EXPECT_LT(angle_of(error), 0.06);
  EXPECT_GT(found.front().score, 0.6);
}

TEST(PoseSearch, GivesTheBestFirstAndNoneTwice) {
  const auto found = search_poses(room(), seen_from(at(7, 4, 0), room()), at(6, 4, 0), {3.0, 0.5}, {});
  ASSERT_GT(found.size(), 3U);
  for (std::size_t i = 1; i < found.size(); ++i) {
    EXPECT_GE(found[i - 1].score, found[i].score);
    const Pose apart = found[0].T_target_source.inverse() * found[i].T_target_source;
    EXPECT_GT(apart.translation().norm() + 10 * angle_of(apart), 0.6);
  }
}

TEST(PoseSearch, StaysWithinItsWindow) {
  const Pose T_start = at(6, 4, 0);
  for (const PoseCandidate& found : search_poses(room(), seen_from(at(14, 4, 0), room()), T_start, {2.0, 0.2}, {})) {
    const Pose moved = T_start.inverse() * found.T_target_source;
    EXPECT_LE(moved.translation().cwiseAbs().maxCoeff(), 2.0 + 1e-9);
    EXPECT_LE(angle_of(moved), 0.2 + 1e-9);
  }
}

TEST(PoseSearch, FindsNothingWhereNothingStandsUpright) {
  std::vector<FacingPoint> floor;
  for (int i = 0; i < 100; ++i) floor.push_back({{0.1 * i, 1, -1}, {0, 0, 1}});
  EXPECT_TRUE(search_poses(room(), floor, at(5, 5, 0), {2.0, 0.2}, {}).empty());
}

}  // namespace
}  // namespace tilth
