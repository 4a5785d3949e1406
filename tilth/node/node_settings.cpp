#include <set>
#include <utility>

#include <tilth/core/error.hpp>
#include <tilth/node/node_settings.hpp>
#include <tilth/odometry/make_odometry.hpp>
#include <tilth/run/base_frame.hpp>
#include <tilth/run/new_record.hpp>

namespace tilth {
namespace {

/// The options of one stage, taken out of `values`.
template <Options O>
O taken(OptionValues& values) {
  OptionValues own;
  for (const OptionInfo& option : describe(O{}))
    if (auto value = values.extract(option.key)) own.insert(std::move(value));
  return with<O>(std::move(own));
}

template <Options O>
std::set<std::string> keys_of(const O& options) {
  std::set<std::string> keys;
  for (OptionInfo& option : describe(options)) keys.insert(std::move(option.key));
  return keys;
}

}  // namespace

NodeSettings read_settings(OptionValues values) {
  NodeSettings settings;
  settings.node = taken<NodeOptions>(values);
  settings.clouds = taken<CloudOptions>(values);
  settings.map = taken<MapOptions>(values);
  settings.slam = taken<SlamOptions>(values);
  settings.localization = taken<LocalizationOptions>(values);
  if (settings.node.loop_closure && !settings.node.map.empty())
    throw Error("loop_closure", "does not go with map: nothing is mapped where a saved map is used");
  if (settings.node.pipeline.empty()) settings.node.pipeline = pipelines().front().name;
  const std::string& mount = settings.node.base_from_lidar;
  if (settings.node.mount_from_tf) {
    if (!mount.empty()) throw Error("base_from_lidar", "does not go with mount_from_tf: one of them tells the mount");
    settings.node.publish_mount = false;
  }
  if (!mount.empty()) settings.T_base_lidar = parse_mount(mount);
  make_odometry(settings.node.pipeline, values);
  settings.pipeline = std::move(values);
  return settings;
}

RunRecord new_record(const NodeSettings& settings) {
  RunRecord record = new_record(kCloudTopic, settings.node.pipeline, settings.pipeline);
  record.T_base_lidar = settings.T_base_lidar;
  record.map = MapBuilder(settings.map);
  return record;
}

std::vector<NodeParameter> node_parameters(const OptionValues& values) {
  const NodeSettings settings = read_settings(values);
  std::vector<NodeParameter> all;
  const std::set<std::string> running = keys_of(NodeRunningOptions{});
  const auto append = [&](const std::vector<OptionInfo>& some) {
    for (const OptionInfo& option : some) all.push_back({option, running.contains(option.key)});
  };
  append(describe(settings.node));
  append(describe(settings.clouds));
  append(describe(settings.map));
  append(describe_odometry(settings.node.pipeline, settings.pipeline));
  append(describe(settings.slam));
  append(describe(settings.localization));
  return all;
}

NodeRunningOptions set_running(const NodeRunningOptions& options, const OptionValues& values) {
  const std::set<std::string> keys = keys_of(options);
  std::string known;
  for (const std::string& key : keys) known += (known.empty() ? "" : ", ") + key;
  for (const auto& [key, value] : values)
    if (!keys.contains(key)) throw Error(key, "is read when the node starts; what may be set later is " + known);
  return with(values, options);
}

}  // namespace tilth
