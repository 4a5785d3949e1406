// A track that is lost on the way and goes on with a new map, somewhere else than it thinks: the maps are joined where
// known ground is seen again, and never where it only looks alike.
#include <algorithm>

#include <gtest/gtest.h>

#include "slam/made_drives.hpp"
#include <tilth/localization/join_pieces.hpp>
#include <tilth/slam/slam.hpp>

namespace tilth {
namespace {

/// From when to when [s] nothing is registered, and where it then thinks it is, seen from where it should.
struct Loss {
  double from, to;
  Pose T_true_thought;
};

/// The truth, but for a loss.
class LosingOdometry : public Odometry {
 public:
  LosingOdometry(const Simulator& simulator, const Loss& loss) : truth_(simulator, {}), loss_(loss) {}

  OdometryResult register_scan(const Scan& scan) override {
    OdometryResult result = truth_.register_scan(scan);
    if (result.stamp < loss_.from) return result;
    if (result.stamp < loss_.to) {
      result.alignment.converged = false;
      result.track = {TrackState::lost, TrackReason::too_few_matches};
      return result;
    }
    if (!T_new_old_) T_new_old_ = result.T_world_lidar * loss_.T_true_thought * result.T_world_lidar.inverse();
    result.alignment.matches = begun_ ? 500 : 0;
    begun_ = true;
    result.relative = true;
    result.track = {TrackState::lost, TrackReason::new_map};
    result.T_world_lidar = *T_new_old_ * result.T_world_lidar;
    return result;
  }
  PointCloud local_map() const override { return {}; }

 private:
  DriftingOdometry truth_;
  Loss loss_;
  bool begun_ = false;
  std::optional<Pose> T_new_old_;
};

Pose thought(double x, double yaw) {
  return Eigen::Translation3d(x, 0.4, 0) * Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ());
}

struct Found {
  std::vector<std::pair<std::size_t, std::size_t>> joined;
  std::size_t scans = 0;
  double error = 0.0;  ///< [m] of the last pose
};

enum class When { at_the_end, on_the_way };

Found drive_with(const Scene& scene, const Loss& loss, When when) {
  constexpr std::size_t kStride = 4;
  const Simulator simulator = simulated(scene);
  Slam slam(std::make_unique<LosingOdometry>(simulator, loss), {});
  if (when == When::on_the_way) slam.after_keyframe(PieceJoiner({}));
  for (std::size_t i = 0; i < simulator.size(); i += kStride) slam.register_scan(simulator.scan(i).scan);
  slam.finish();
  if (when == When::at_the_end) join_pieces(slam.loops(), {});
  const Trajectory way = slam.trajectory();
  const Pose motion = way.front().T_world_lidar.inverse() * way.back().T_world_lidar;
  const Pose truth = true_motion(simulator, way.front().stamp, way.back().stamp);
  return {slam.joined_scans(), way.size(), (motion.translation() - truth.translation()).norm()};
}

const std::vector<Leg> kThereAndBack{{1, 0, 0},    {18, 1.0, 0}, {1, 0, 0}, {4, 0, std::numbers::pi},
                                     {17, 1.0, 0}, {2, 0, 0}};

class JoinPieces : public testing::TestWithParam<When> {};

TEST_P(JoinPieces, ANewMapIsJoinedWhereKnownGroundIsSeenAgain) {
  const Scene scene = corridor_scene({26, {3, 4.7, 9, 13, 14.5, 19, 21, 23.5}}, kThereAndBack);
  const Found found = drive_with(scene, {26, 30, thought(2.5, 0.6)}, GetParam());
  ASSERT_EQ(found.joined.size(), 1U);
  EXPECT_EQ(found.joined[0].second, found.scans);
  EXPECT_GT(found.joined[0].first, found.scans / 2);
  EXPECT_LT(found.error, 0.02);
}

TEST_P(JoinPieces, ANewMapStaysAloneWhereEveryDoorIsLikeTheNext) {
  std::vector<double> doors;
  for (double at = 1; at < 58; at += 1.5) doors.push_back(at);
  const std::vector<Leg> legs{{1, 0, 0}, {14, 1.0, 0}, {1, 0, 0}, {4, 0, std::numbers::pi}, {10, 1.0, 0}, {1, 0, 0}};
  std::vector<Leg> in_the_middle{{1, 0, 0}, {20, 1.0, 0}};
  in_the_middle.insert(in_the_middle.end(), legs.begin(), legs.end());
  const Found found =
      drive_with(corridor_scene({60, doors, false}, in_the_middle), {44, 47, thought(1.5, 0.1)}, GetParam());
  EXPECT_TRUE(found.joined.empty());
}

TEST_P(JoinPieces, ANewMapStaysAloneOnNewGround) {
  const Scene scene =
      corridor_scene({60, {3, 4.7, 9, 13, 14.5, 19, 21, 23.5, 31, 33.1, 40}}, {{1, 0, 0}, {36, 1.5, 0}});
  const Found found = drive_with(scene, {15, 18, thought(-2, 0.2)}, GetParam());
  EXPECT_TRUE(found.joined.empty());
}

INSTANTIATE_TEST_SUITE_P(Drives, JoinPieces, testing::Values(When::at_the_end, When::on_the_way));

}  // namespace
}  // namespace tilth
