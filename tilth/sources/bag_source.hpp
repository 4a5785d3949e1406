// Point clouds or packets of a ROS 1 or ROS 2 bag.
#pragma once

#include <filesystem>
#include <memory>

#include <tilth/sources/open_source.hpp>

namespace tilth {

/// One topic: sensor_msgs/PointCloud2 by the stamps of their headers, or packets (see packet_message.hpp). Messages
/// that cannot be read are passed over; damage of the bag is told in skipped(). Throws Error listing the topics where
/// `options.topic` is none of them, or is empty and there is not exactly one of point clouds, or else of packets.
std::unique_ptr<ScanSource> open_bag(const std::filesystem::path& path, const SourceOptions& options);

}  // namespace tilth
