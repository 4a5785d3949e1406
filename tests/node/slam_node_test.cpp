// A node without its middleware: the poses are those of a run on the same clouds, frames and stamps are right, a map is
// saved, and what is not understood is refused or said.
#include <functional>
#include <io/temporary_folder.hpp>
#include <map>
#include <node/kept_messages.hpp>
#include <sources/driven_clouds.hpp>
#include <thread>

#include <gtest/gtest.h>

#include <tilth/core/error.hpp>
#include <tilth/io/trajectory_file.hpp>
#include <tilth/messages/point_cloud2.hpp>
#include <tilth/messages/pose_message.hpp>
#include <tilth/node/node_options.hpp>
#include <tilth/node/parameter_value.hpp>
#include <tilth/node/slam_node.hpp>
#include <tilth/odometry/make_odometry.hpp>
#include <tilth/run/base_frame.hpp>
#include <tilth/run/session.hpp>
#include <tilth/sources/cloud_source.hpp>

namespace tilth {
namespace {

constexpr std::size_t kClouds = 20;
constexpr double kStill = 5.0;  // [s] for which the sensor stands before it sets off
const std::string kMount = "0.3,0.1,0.7,2,-3,20";

constexpr const char* kDrive = "sim://corridor?seed=5&columns=450&speed=2&duration=7.6";

/// Along the corridor.
const std::vector<Message>& clouds() {
  static const std::vector<Message> all = driven_clouds(kDrive, kStill);
  return all;
}

/// The poses of the LiDAR that `tilth run` finds on a recording of the clouds.
Trajectory poses_of_run(const Pose& T_world_start) {
  std::size_t next = 0;
  const auto hand_over = [&]() -> std::optional<Message> {
    return next < clouds().size() ? std::optional(clouds()[next++]) : std::nullopt;
  };
  Session session(open_clouds({.name = "memory", .next = hand_over}, "", {}, {}), {make_odometry("tilth")});
  session.run();
  Trajectory poses = session.record().trajectory;
  for (StampedPose& pose : poses) pose.T_world_lidar = T_world_start * pose.T_world_lidar;
  return poses;
}

/// Takes all clouds in one go: none is to be dropped.
const OptionValues kKeepAll{{"queue", "100"}, {"map_period", "0"}};

void give_all(SlamNode& node) {
  for (const Message& cloud : clouds()) node.take(cloud.bytes, cloud.stamp);
}

TEST(SlamNode, FindsThePosesOfARunToTheLastBit) {
  const Trajectory expected = poses_of_run(Pose::Identity());
  ASSERT_GE(expected.size(), kClouds);
  ASSERT_GT(expected.back().T_world_lidar.translation().norm(), 1.0) << "it moves";
  Kept kept;
  SlamNode node(kKeepAll, kept);
  give_all(node);
  const auto messages = kept.wait_for(NodeTopic::odometry, expected.size());
  ASSERT_EQ(messages.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    RosMessageReader reader(messages[i], Serialization::cdr, "Odometry");
    const ReadTransform pose = read_transform(reader);
    EXPECT_NEAR(pose.stamp, expected[i].stamp, 1e-9);
    EXPECT_EQ(pose.parent, "odom");
    EXPECT_EQ(pose.child, "velodyne");
    EXPECT_EQ(pose.translation, Eigen::Vector3d(expected[i].T_world_lidar.translation()));
    EXPECT_EQ(pose.rotation.coeffs(), Eigen::Quaterniond(expected[i].T_world_lidar.linear()).coeffs());
    const double variance = std::bit_cast<double>(reader.number<std::uint64_t>("covariance"));
    EXPECT_EQ(variance > 0.0, i > 0) << "the first pose is where the frame begins";
  }
}

/// The odometry that a node sends of the clouds, both in that serialisation.
std::vector<ReadTransform> odometry_in(Serialization serialization) {
  Kept kept(serialization);
  SlamNode node(kKeepAll, kept);
  const std::vector<Message> sent = driven_clouds(kDrive, kStill, serialization);
  for (const Message& cloud : sent) node.take(cloud.bytes, cloud.stamp);
  std::vector<ReadTransform> poses;
  for (const std::vector<std::byte>& message : kept.wait_for(NodeTopic::odometry, sent.size())) {
    RosMessageReader reader(message, serialization, "Odometry");
    poses.push_back(read_transform(reader));
  }
  return poses;
}

TEST(SlamNode, FindsTheSamePosesInMessagesOfRos1) {
  const std::vector<ReadTransform> here = odometry_in(Serialization::ros1), there = odometry_in(Serialization::cdr);
  ASSERT_GE(here.size(), kClouds);
  ASSERT_EQ(here.size(), there.size());
  for (std::size_t i = 0; i < here.size(); ++i) {
    EXPECT_EQ(here[i].stamp, there[i].stamp);
    EXPECT_EQ(here[i].child, there[i].child);
    EXPECT_EQ(here[i].translation, there[i].translation);
  }
}

TEST(SlamNode, BeginsAtTheBaseAndTellsWhereTheLidarIsMounted) {
  const Pose T_base_lidar = parse_mount(kMount);
  const Trajectory of_lidar = poses_of_run(T_base_lidar);
  Kept kept;
  OptionValues values = kKeepAll;
  values["base_from_lidar"] = kMount;
  SlamNode node(values, kept);
  give_all(node);
  const auto messages = kept.wait_for(NodeTopic::tf, of_lidar.size());
  ASSERT_EQ(messages.size(), of_lidar.size());
  for (std::size_t i = 0; i < messages.size(); ++i) {
    const std::vector<ReadTransform> both = read_tf(messages[i]);
    ASSERT_EQ(both.size(), 2U);
    EXPECT_EQ(both[0].parent + " " + both[0].child, "map odom");
    EXPECT_TRUE(both[0].translation.isZero()) << "without loop closure";
    EXPECT_EQ(both[1].parent + " " + both[1].child, "odom base_link");
    const Pose expected = pose_of_base(of_lidar[i].T_world_lidar, T_base_lidar);
    EXPECT_LT((both[1].translation - expected.translation()).norm(), 1e-12);
    EXPECT_LT(both[1].rotation.angularDistance(Eigen::Quaterniond(expected.linear())), 1e-7);
  }
  const auto fixed = kept.wait_for(NodeTopic::tf_static, 1);
  ASSERT_EQ(fixed.size(), 1U) << "once";
  const std::vector<ReadTransform> mount = read_tf(fixed.front());
  ASSERT_EQ(mount.size(), 1U);
  EXPECT_EQ(mount[0].parent + " " + mount[0].child, "base_link velodyne");
  EXPECT_EQ(mount[0].translation, Eigen::Vector3d(0.3, 0.1, 0.7));
}

TEST(SlamNode, WaitsForTheMountThatTfTells) {
  const Pose T_base_mast(Eigen::Translation3d(0.3, 0, 0.5)), T_mast_lidar = parse_mount("0,0.1,0.2,2,-3,20");
  Kept kept;
  OptionValues values = kKeepAll;
  values["mount_from_tf"] = "true";
  SlamNode node(values, kept);
  give_all(node);
  EXPECT_NE(kept.wait_for_warning().find("velodyne is mounted on base_link"), std::string::npos);
  EXPECT_TRUE(kept.wait_for(NodeTopic::odometry, 0).empty());
  const StampedTransform fixed[] = {{0.0, {"mast", "velodyne"}, T_mast_lidar},
                                    {0.0, {"base_link", "mast"}, T_base_mast}};
  node.take_static_transforms(serialize_tf({fixed, 1}));
  node.take_static_transforms(std::vector<std::byte>(9, std::byte{7}));
  node.take_static_transforms(serialize_tf({fixed + 1, 1}));
  const Pose T_base_lidar = T_base_mast * T_mast_lidar;
  const Trajectory of_lidar = poses_of_run(T_base_lidar);
  const auto messages = kept.wait_for(NodeTopic::tf, of_lidar.size());
  ASSERT_EQ(messages.size(), of_lidar.size());
  const std::vector<ReadTransform> both = read_tf(messages.back());
  EXPECT_EQ(both[1].child, "base_link");
  const Pose expected = pose_of_base(of_lidar.back().T_world_lidar, T_base_lidar);
  EXPECT_LT((both[1].translation - expected.translation()).norm(), 1e-9);
  EXPECT_TRUE(kept.wait_for(NodeTopic::tf_static, 0).empty()) << "others tell it";
}

TEST(SlamNode, SendsScanMapAndPathInTheirFrames) {
  Kept kept;
  OptionValues values = kKeepAll;
  values["scan_points"] = "500", values["map_points"] = "300";
  SlamNode node(values, kept);
  give_all(node);
  const PointCloud2 scan = parse_point_cloud2(kept.wait_for(NodeTopic::scan, 3)[2], Serialization::cdr);
  EXPECT_EQ(scan.frame_id, "velodyne");
  EXPECT_EQ(scan.records.count, 500U);
  const PointCloud2 map = parse_point_cloud2(kept.wait_for(NodeTopic::map, kClouds).back(), Serialization::cdr);
  EXPECT_EQ(map.frame_id, "map");
  EXPECT_GT(map.records.count, 100U);
  EXPECT_LE(map.records.count, 300U);
  const auto paths = kept.wait_for(NodeTopic::path, kClouds);
  ASSERT_GE(paths.size(), kClouds);
  RosMessageReader path(paths[kClouds - 1], Serialization::cdr, "Path");
  EXPECT_EQ(path.header().frame_id, "map");
  EXPECT_EQ(path.number<std::uint32_t>("poses"), kClouds);
}

TEST(SlamNode, SavesTheMapWhileNoCloudComes) {
  const TemporaryFolder folder;
  Kept kept;
  OptionValues values = kKeepAll;
  values["save_map"] = (folder / "saved").string();
  SlamNode node(values, kept);
  EXPECT_THROW(node.save_map(), Error) << "there is none";
  give_all(node);
  kept.wait_for(NodeTopic::map, clouds().size());
  EXPECT_NE(node.save_map().find(std::to_string(clouds().size()) + " poses"), std::string::npos);
  const Trajectory saved = read_tum(folder / "saved/trajectory.tum"), expected = poses_of_run(Pose::Identity());
  ASSERT_EQ(saved.size(), expected.size());
  EXPECT_LT((saved.back().T_world_lidar.translation() - expected.back().T_world_lidar.translation()).norm(), 1e-6);
  EXPECT_TRUE(std::filesystem::exists(folder / "saved/map.pcd"));
}

/// The first pose after all clouds were registered, `node` was asked for a new beginning, and clouds came again.
Eigen::Vector3d first_after(const std::function<void(SlamNode&)>& begin_anew, Kept& kept) {
  SlamNode node(kKeepAll, kept);
  give_all(node);
  const std::size_t before = kept.wait_for(NodeTopic::odometry, clouds().size()).size();
  begin_anew(node);
  for (std::size_t i = 0; kept.wait_for(NodeTopic::odometry, 0).size() == before && i < 200; ++i) {
    node.take(clouds()[i % clouds().size()].bytes, clouds()[i % clouds().size()].stamp);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  const auto messages = kept.wait_for(NodeTopic::odometry, before + 1);
  if (messages.size() <= before) throw Error("test", "no pose came");
  RosMessageReader reader(messages[before], Serialization::cdr, "Odometry");
  return read_transform(reader).translation;
}

TEST(SlamNode, BeginsAnewAfterAReset) {
  Kept kept;
  EXPECT_LT(first_after([](SlamNode& node) { node.reset(); }, kept).norm(), 0.2) << "the world is at its first scan";
}

TEST(SlamNode, BeginsAnewWhereStampsFallBack) {
  Kept kept;
  EXPECT_LT(first_after([](SlamNode& node) { node.take(clouds()[0].bytes, 0); }, kept).norm(), 0.2);
  EXPECT_NE(kept.wait_for_warning().find("fall back by 2."), std::string::npos) << kept.wait_for_warning();
}

TEST(SlamNode, SaysWhyItCannotBeginAndTriesAgain) {
  Kept kept;
  SlamNode node(kKeepAll, kept);
  for (int i = 0; i < 50; ++i) node.take(std::vector<std::byte>(100, std::byte{7}), 0);
  EXPECT_NE(kept.wait_for_warning().find("no scan can be read"), std::string::npos) << kept.wait_for_warning();
  for (int i = 0; i < 100 && kept.wait_for(NodeTopic::odometry, 0).empty(); ++i) {
    node.take(clouds()[std::size_t(i) % clouds().size()].bytes, 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  EXPECT_FALSE(kept.wait_for(NodeTopic::odometry, 1).empty());
}

TEST(NodeParameters, AreTheOptionsWithTheirBounds) {
  std::map<std::string, NodeParameter> all;
  for (const NodeParameter& parameter : node_parameters({{"map_voxel", "0.2"}})) all[parameter.key] = parameter;
  EXPECT_EQ(all.at("map_voxel").value, "0.2");
  EXPECT_EQ(all.at("queue").allowed, "1 .. 1000");
  EXPECT_EQ(type_of(all.at("queue")), ParameterType::integer);
  EXPECT_EQ(type_of(all.at("localize.track_patches")), ParameterType::integer) << "in groups as well";
  EXPECT_EQ(type_of(all.at("map_voxel")), ParameterType::number);
  EXPECT_EQ(type_of(all.at("publish_tf")), ParameterType::flag);
  EXPECT_EQ(type_of(all.at("times")), ParameterType::text);
  EXPECT_TRUE(all.contains("base_from_lidar"));
  for (const OptionInfo& option : describe_odometry("tilth", {})) EXPECT_TRUE(all.contains(option.key)) << option.key;
  EXPECT_THROW(node_parameters({{"map_voxle", "0.2"}}), Error);
  EXPECT_THROW(node_parameters({{"queue", "0"}}), Error);
  EXPECT_THROW(node_parameters({{"base_from_lidar", "1,2"}}), Error);
  EXPECT_THROW(node_parameters({{"pipeline", "none"}}), Error);
  EXPECT_THROW(node_parameters({{"mount_from_tf", "true"}, {"base_from_lidar", kMount}}), Error);
  EXPECT_THROW(node_parameters({{"map", "somewhere"}, {"loop_closure", "true"}}), Error);
}

}  // namespace
}  // namespace tilth
