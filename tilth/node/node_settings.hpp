// The parameters of a node, each read where it belongs.
#pragma once

#include <optional>

#include <tilth/core/se3.hpp>
#include <tilth/localization/localizer.hpp>
#include <tilth/node/node_options.hpp>
#include <tilth/run/run_record.hpp>
#include <tilth/sensor/scan_decoder.hpp>
#include <tilth/slam/slam.hpp>

namespace tilth {

struct NodeSettings {
  NodeOptions node;
  CloudOptions clouds;
  MapOptions map;
  SlamOptions slam;
  LocalizationOptions localization;
  OptionValues pipeline;  ///< of the pipeline that `node` names
  std::optional<Pose> T_base_lidar;
};

/// Throws Error as node_parameters() does.
NodeSettings read_settings(OptionValues values);

/// `options` with `values` set, which are valid. Throws Error naming a key that is another parameter's.
NodeRunningOptions set_running(const NodeRunningOptions& options, const OptionValues& values);

inline constexpr const char* kCloudTopic = "topic points";

/// A record of clouds of that topic, without scans.
RunRecord new_record(const NodeSettings& settings);

}  // namespace tilth
