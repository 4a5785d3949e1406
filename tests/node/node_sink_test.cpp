// With loop closure the robot's way in odom has no jumps; map -> odom, the path and the map take up what is corrected.
#include <node/kept_messages.hpp>
#include <run/scan_list.hpp>
#include <slam/made_drives.hpp>

#include <gtest/gtest.h>

#include <tilth/messages/point_cloud2.hpp>
#include <tilth/node/node_sink.hpp>
#include <tilth/run/session.hpp>

namespace tilth {
namespace {

constexpr double kPi = std::numbers::pi;

/// Scans that come as slowly as their loops are closed.
class UnhurriedScans : public ScanList {
 public:
  UnhurriedScans(std::vector<Scan> scans, const Slam& slam) : ScanList(std::move(scans)), slam_(slam) {}
  std::optional<Scan> next() override {
    slam_.loops();
    return ScanList::next();
  }

 private:
  const Slam& slam_;
};

/// There and back through a corridor, with an odometry that drifts.
class LoopedRun {
 public:
  LoopedRun()
      : simulator_(
            simulated(corridor_scene({26, {3, 4.7, 9, 13, 14.5, 19, 21, 23.5}},
                                     {{1, 0, 0}, {18, 1.0, 0}, {1, 0, 0}, {4, 0, kPi}, {17, 1.0, 0}, {2, 0, 0}}))),
        settings_(read_settings({{"map_period", "0"}, {"loop_closure", "true"}})) {
    std::vector<Scan> scans;
    for (std::size_t i = 0; i < simulator_.size(); i += 4) scans.push_back(simulator_.scan(i).scan);
    auto slam = std::make_unique<Slam>(
        std::make_unique<DriftingOdometry>(simulator_, Drift{.scale = 0.005, .turn = 0.001}), settings_.slam);
    slam_ = slam.get();
    session_ = std::make_unique<Session>(std::make_unique<UnhurriedScans>(std::move(scans), *slam_),
                                         Pipeline{std::move(slam)});
    session_->add(std::make_unique<NodeSink>(NodeSurroundings{settings_, inbox_, kept}, slam_, "velodyne"));
    session_->run();
    EXPECT_TRUE(session_->finish().empty());
  }

  const Trajectory& odometry() const { return session_->record().trajectory; }
  PointRecords map(bool corrected) const {
    return map_of(session_->record(), corrected ? slam_ : nullptr).thinned_records(settings_.node.running.map_points);
  }
  Trajectory corrected() const { return slam_->trajectory(); }
  Pose end() const { return true_motion(simulator_, odometry().front().stamp, odometry().back().stamp); }

  Kept kept;

 private:
  Simulator simulator_;
  NodeSettings settings_;
  CloudInbox inbox_{1};
  std::unique_ptr<Session> session_;
  const Slam* slam_ = nullptr;
};

LoopedRun& looped() {
  static LoopedRun run;
  return run;
}

TEST(NodeSink, CorrectsTheMapAndLeavesTheWayInOdomSmooth) {
  LoopedRun& run = looped();
  const std::size_t scans = run.odometry().size();
  ASSERT_GT((run.odometry().back().T_world_lidar.translation() - run.end().translation()).norm(), 0.2);
  const auto messages = run.kept.wait_for(NodeTopic::tf, scans);
  ASSERT_EQ(messages.size(), scans);
  double jump = 0.0;
  Pose T_map_lidar = Pose::Identity();
  for (std::size_t i = 0; i < scans; ++i) {
    const std::vector<ReadTransform> both = read_tf(messages[i]);
    ASSERT_EQ(both.size(), 2U);
    EXPECT_EQ(both[1].translation, Eigen::Vector3d(run.odometry()[i].T_world_lidar.translation()));
    jump = std::max(jump, both[0].translation.norm());
    T_map_lidar = Eigen::Translation3d(both[0].translation) * both[0].rotation *
                  Eigen::Translation3d(both[1].translation) * both[1].rotation;
  }
  EXPECT_GT(jump, 0.1) << "map -> odom moves";
  EXPECT_LT((T_map_lidar.translation() - run.corrected().back().T_world_lidar.translation()).norm(), 1e-6);
  EXPECT_LT((T_map_lidar.translation() - run.end().translation()).norm(), 0.05) << "where the sensor truly is";
}

TEST(NodeSink, SendsPathAndMapAsTheyAreCorrected) {
  LoopedRun& run = looped();
  const auto paths = run.kept.wait_for(NodeTopic::path, run.odometry().size());
  RosMessageReader path(paths.back(), Serialization::cdr, "Path");
  path.header();
  const Trajectory corrected = run.corrected();
  ASSERT_EQ(path.number<std::uint32_t>("poses"), corrected.size());
  for (const StampedPose& pose : corrected) {
    path.header();
    for (int axis = 0; axis < 3; ++axis)
      ASSERT_NEAR(std::bit_cast<double>(path.number<std::uint64_t>("position")), pose.T_world_lidar.translation()[axis],
                  1e-9);
    for (int i = 0; i < 4; ++i) path.number<std::uint64_t>("orientation");
  }
  const PointCloud2 map = parse_point_cloud2(run.kept.wait_for(NodeTopic::map, 1).back(), Serialization::cdr);
  EXPECT_GT(map.records.count, 10'000U);
  EXPECT_EQ(map.records.bytes, run.map(true).bytes);
  EXPECT_NE(map.records.bytes, run.map(false).bytes);
}

}  // namespace
}  // namespace tilth
