// Parameters that are set while a node runs hold from then on; all others are refused, and nothing is set by halves.
#include <node/kept_messages.hpp>
#include <sources/driven_clouds.hpp>

#include <gtest/gtest.h>

#include <tilth/core/error.hpp>
#include <tilth/node/node_options.hpp>
#include <tilth/node/parameter_value.hpp>
#include <tilth/node/slam_node.hpp>

namespace tilth {
namespace {

const std::vector<Message>& clouds() {
  static const std::vector<Message> all = driven_clouds("sim://corridor?seed=5&columns=450&duration=2.5", 0.0);
  return all;
}

std::string value_of(const std::string& key, SlamNode& node) {
  for (const NodeParameter& parameter : node.parameters())
    if (parameter.key == key) return parameter.value;
  return "";
}

/// Why the node does not set these; empty: it does.
std::string refusal(SlamNode& node, const OptionValues& values) {
  const SlamNode::Answer answer = node.set(values);
  EXPECT_EQ(answer.success, answer.message.empty());
  return answer.message;
}

/// Its value as a middleware sends it.
std::string as_sent(const NodeParameter& parameter) {
  return parameter.whole ? parameter_text(number_of(parameter)) : parameter.value;
}

TEST(RunningParameters, HoldFromThenOn) {
  Kept kept;
  SlamNode node({{"queue", "100"}, {"map_period", "3600"}}, kept);
  const std::size_t half = clouds().size() / 2;
  for (std::size_t i = 0; i < half; ++i) node.take(clouds()[i].bytes, clouds()[i].stamp);
  kept.wait_for(NodeTopic::scan, half);
  EXPECT_EQ(refusal(node, {{"publish_tf", "false"}, {"scan_points", "500"}, {"map_period", "0"}}), "");
  const std::size_t maps = kept.wait_for(NodeTopic::map, 1).size();
  for (std::size_t i = half; i < clouds().size(); ++i) node.take(clouds()[i].bytes, clouds()[i].stamp);
  const auto scans = kept.wait_for(NodeTopic::scan, clouds().size());
  ASSERT_EQ(scans.size(), clouds().size());
  const auto points = [&](std::size_t i) { return parse_point_cloud2(scans[i], Serialization::cdr).records.count; };
  EXPECT_GT(points(0), 500U);
  EXPECT_EQ(points(clouds().size() - 1), 500U);
  EXPECT_EQ(kept.wait_for(NodeTopic::tf, 0).size(), half);
  EXPECT_EQ(kept.wait_for(NodeTopic::map, maps + clouds().size() - half).size(), maps + clouds().size() - half);
  EXPECT_EQ(value_of("scan_points", node), "500");
  EXPECT_EQ(value_of("publish_tf", node), "false");
}

TEST(RunningParameters, LimitTheQueue) {
  Kept kept;
  SlamNode node({{"queue", "100"}}, kept);
  const std::size_t half = clouds().size() / 2;
  for (std::size_t i = 0; i < half; ++i) node.take(clouds()[i].bytes, clouds()[i].stamp);
  ASSERT_EQ(kept.wait_for(NodeTopic::odometry, half).size(), half);
  EXPECT_EQ(refusal(node, {{"queue", "1"}}), "");
  for (std::size_t i = half; i < clouds().size(); ++i) node.take(clouds()[i].bytes, clouds()[i].stamp);
  EXPECT_NE(kept.wait_for_warning().find("dropped"), std::string::npos);
}

TEST(RunningParameters, AreSetTogetherOrNotAtAll) {
  Kept kept;
  SlamNode node({{"map_voxel", "0.2"}}, kept);
  EXPECT_NE(refusal(node, {{"path_poses", "7"}, {"map_points", "0"}}).find("map_points"), std::string::npos);
  EXPECT_NE(refusal(node, {{"path_poses", "7"}, {"map_voxel", "0.1"}}).find("is read when the node starts"),
            std::string::npos);
  EXPECT_NE(refusal(node, {{"path_poses", "7"}, {"path_posse", "8"}}).find("path_posse"), std::string::npos);
  EXPECT_EQ(value_of("path_poses", node), "5000");
  EXPECT_EQ(value_of("map_voxel", node), "0.2");
  for (const NodeParameter& parameter : node.parameters())
    EXPECT_EQ(parameter.running, refusal(node, {{parameter.key, as_sent(parameter)}}).empty()) << parameter.key;
}

}  // namespace
}  // namespace tilth
