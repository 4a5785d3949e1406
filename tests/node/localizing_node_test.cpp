// A node in a map that another one saved: poses in the map's frame where the place is known, and nothing is claimed
// where it is not.
#include <io/temporary_folder.hpp>
#include <node/kept_messages.hpp>
#include <sources/driven_clouds.hpp>
#include <tuple>

#include <gtest/gtest.h>

#include <tilth/core/error.hpp>
#include <tilth/io/trajectory_file.hpp>
#include <tilth/messages/pose_estimate.hpp>
#include <tilth/node/slam_node.hpp>
#include <tilth/simulation/simulator.hpp>

namespace tilth {
namespace {

constexpr double kSetOff = 5.0, kSeen = 7.0;  // [s] of the drive that is mapped, and of the one that is located
const std::string kWorld = "world_seed=7&columns=450&speed=2&duration=";
const Pose kMount(Eigen::Translation3d(0.3, 0.1, 0.7));

Trajectory truth_of(const std::string& seed) {
  return Simulator("corridor", simulation_options("corridor", {{"seed", seed}, {"world_seed", "7"}, {"speed", "2"}}))
      .truth();
}

/// A drive that was mapped and saved, and another one through the same corridor.
struct Drives {
  TemporaryFolder folder;
  std::vector<Message> second = driven_clouds("sim://corridor?seed=6&" + kWorld + "13", kSeen);
  Trajectory first_poses;

  Drives() {
    const std::vector<Message> first = driven_clouds("sim://corridor?seed=5&" + kWorld + "15", kSetOff);
    Kept kept;
    SlamNode node({{"queue", "1000"}, {"loop_closure", "true"}, {"save_map", (folder / "saved").string()}}, kept);
    for (const Message& cloud : first) node.take(cloud.bytes, cloud.stamp);
    kept.wait_for(NodeTopic::odometry, first.size());
    const SlamNode::Answer answer = node.serve("save_map");
    if (!answer.success) throw Error("test", answer.message);
    first_poses = read_tum(folder / "saved/trajectory.tum");
  }

  OptionValues parameters() const {
    return {{"queue", "1000"}, {"map", (folder / "saved/places").string()}, {"base_from_lidar", "0.3,0.1,0.7,0,0,0"}};
  }
};

Drives& drives() {
  static Drives made;
  return made;
}

/// [m] from the truth, of the base in the map, by the transforms of one message.
double error_of(const std::vector<ReadTransform>& both) {
  static const Trajectory mapped = truth_of("5"), driven = truth_of("6");
  const Pose T_world_map = interpolate(mapped, drives().first_poses.front().stamp);
  const Pose expected = T_world_map.inverse() * interpolate(driven, both[1].stamp) * kMount.inverse();
  const Pose T_map_base(Eigen::Translation3d(both[0].translation) * both[0].rotation *
                        Eigen::Translation3d(both[1].translation) * both[1].rotation);
  return (T_map_base.translation() - expected.translation()).norm();
}

std::string last_diagnostic(Kept& kept) {
  const std::vector<std::byte> message = kept.wait_for(NodeTopic::diagnostics, 1).back();
  return {reinterpret_cast<const char*>(message.data()), message.size()};
}

TEST(LocalizingNode, FindsItselfInTheMapOfAnotherDrive) {
  Kept kept;
  SlamNode node(drives().parameters(), kept);
  const std::vector<Message>& clouds = drives().second;
  for (const Message& cloud : clouds) node.take(cloud.bytes, cloud.stamp);
  const auto messages = kept.wait_for(NodeTopic::tf, clouds.size());
  ASSERT_EQ(messages.size(), clouds.size());
  ASSERT_EQ(read_tf(messages.front()).size(), 1U) << "the place is not known yet";
  EXPECT_EQ(read_tf(messages.front())[0].parent, "odom");
  std::size_t known = 0;
  Eigen::Vector3d before = Eigen::Vector3d::Zero();
  for (const std::vector<std::byte>& message : messages) {
    const std::vector<ReadTransform> transforms = read_tf(message);
    EXPECT_LT((transforms.back().translation - before).norm(), 0.5) << "no jump in odom";
    before = transforms.back().translation;
    if (transforms.size() < 2) continue;
    ++known;
    EXPECT_EQ(transforms[0].parent + " " + transforms[0].child, "map odom");
    EXPECT_LT(error_of(transforms), 0.05);
  }
  EXPECT_GT(known, clouds.size() / 2);
  EXPECT_NE(last_diagnostic(kept).find("located"), std::string::npos);
  const PointCloud2 map = parse_point_cloud2(kept.wait_for(NodeTopic::map, 1).front(), Serialization::cdr);
  EXPECT_EQ(map.frame_id, "map");
  EXPECT_GT(map.records.count, 1000U);
  EXPECT_EQ(kept.wait_for(NodeTopic::map, 1).size(), 1U) << "it stays as it is";
  EXPECT_FALSE(node.serve("save_map").success);
}

TEST(LocalizingNode, SearchesAnewWhenAsked) {
  Kept kept;
  SlamNode node(drives().parameters(), kept);
  EXPECT_FALSE(node.serve("localize").success) << "no cloud came yet";
  const std::vector<Message>& clouds = drives().second;
  const std::size_t half = clouds.size() / 2;
  for (std::size_t i = 0; i < half; ++i) node.take(clouds[i].bytes, clouds[i].stamp);
  ASSERT_EQ(read_tf(kept.wait_for(NodeTopic::tf, half).back()).size(), 2U);
  kept.wait_for(NodeTopic::diagnostics, half);
  const SlamNode::Answer answer = node.serve("localize");
  EXPECT_TRUE(answer.success);
  EXPECT_NE(answer.message.find("was located"), std::string::npos) << answer.message;
  for (std::size_t i = half; i < clouds.size(); ++i) node.take(clouds[i].bytes, clouds[i].stamp);
  const auto messages = kept.wait_for(NodeTopic::tf, clouds.size());
  ASSERT_EQ(messages.size(), clouds.size());
  const std::vector<ReadTransform> last = read_tf(messages[half - 1]), next = read_tf(messages[half]);
  ASSERT_EQ(next.size(), 1U) << "nothing is claimed";
  EXPECT_LT((next[0].translation - last[1].translation).norm(), 0.3) << "the way in odom goes on";
  ASSERT_EQ(read_tf(messages.back()).size(), 2U);
  EXPECT_LT(error_of(read_tf(messages.back())), 0.05);
}

/// "About there": where the base truly is in the map at `stamp`, moved by an offset.
std::vector<std::byte> guess_at(double stamp, const Eigen::Vector3d& offset, const std::string& frame = "map") {
  const Pose T_map_world = interpolate(truth_of("5"), drives().first_poses.front().stamp).inverse();
  const Pose T_map_base =
      Eigen::Translation3d(offset) * T_map_world * interpolate(truth_of("6"), stamp) * kMount.inverse();
  return serialize_pose_estimate({stamp, T_map_base}, Matrix6d::Identity(), frame);
}

TEST(LocalizingNode, SearchesWhereItIsSaidToBe) {
  Kept kept;
  SlamNode node(drives().parameters(), kept);
  node.take_guess(guess_at(kSeen, {0, 60, 0}));  // before any cloud came
  const std::vector<Message>& clouds = drives().second;
  const std::size_t half = clouds.size() / 2;
  for (std::size_t i = 0; i < half; ++i) node.take(clouds[i].bytes, clouds[i].stamp);
  for (const auto& message : kept.wait_for(NodeTopic::tf, half)) EXPECT_EQ(read_tf(message).size(), 1U) << "not there";
  kept.wait_for(NodeTopic::diagnostics, half);
  EXPECT_TRUE(kept.wait_for(NodeTopic::pose, 0).empty());
  node.take_guess(guess_at(1e-9 * double(clouds[half].stamp) - 0.1, {0.5, -0.3, 0}));
  for (std::size_t i = half; i < clouds.size(); ++i) node.take(clouds[i].bytes, clouds[i].stamp);
  const auto messages = kept.wait_for(NodeTopic::tf, clouds.size());
  kept.wait_for(NodeTopic::diagnostics, clouds.size());
  const auto poses = kept.wait_for(NodeTopic::pose, 1);
  std::size_t known = 0;
  for (const std::vector<std::byte>& message : messages) {
    const std::vector<ReadTransform> both = read_tf(message);
    if (both.size() < 2) continue;
    EXPECT_LT(error_of(both), 0.05);
    ASSERT_LT(known, poses.size());
    const PoseGuess pose = parse_pose_guess(poses[known++], Serialization::cdr);
    EXPECT_EQ(pose.world, "map");
    const Pose T_map_base(Eigen::Translation3d(both[0].translation) * both[0].rotation *
                          Eigen::Translation3d(both[1].translation) * both[1].rotation);
    EXPECT_TRUE(pose.T_world_body.isApprox(T_map_base, 1e-6));
  }
  EXPECT_GT(known, half / 2);
  EXPECT_EQ(poses.size(), known) << "told while it is known, and only then";
}

TEST(LocalizingNode, LeavesOutAGuessThatIsNotUnderstood) {
  for (const auto& [parameters, guess, reason] :
       {std::tuple{drives().parameters(), guess_at(kSeen, {0, 0, 0}, "world"), "expected 'map'"},
        std::tuple{drives().parameters(), std::vector<std::byte>(20), "PoseWithCovarianceStamped"},
        std::tuple{OptionValues{}, guess_at(kSeen, {0, 0, 0}), "no map to be found in"}}) {
    Kept kept;
    SlamNode node(parameters, kept);
    node.take_guess(guess);
    EXPECT_NE(kept.wait_for_warning().find(reason), std::string::npos) << kept.wait_for_warning();
  }
}

TEST(LocalizingNode, RefusesWhatIsNoMap) {
  Kept kept;
  EXPECT_THROW(SlamNode({{"map", (drives().folder / "nowhere").string()}}, kept), Error);
  SlamNode node({}, kept);
  EXPECT_FALSE(node.serve("localize").success);
  EXPECT_FALSE(node.serve("fly").success);
}

}  // namespace
}  // namespace tilth
