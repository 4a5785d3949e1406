// Point clouds of a ROS 1 bag.
#pragma once

#include <filesystem>
#include <memory>

#include <tilth/sources/open_source.hpp>

namespace tilth {

/// The sensor_msgs/PointCloud2 messages of one topic, by the stamps of their headers. Messages that cannot be read are
/// passed over; damage of the bag is told in skipped(). Throws Error listing the topics where `options.topic` is none
/// of them, or is empty and there is not exactly one.
std::unique_ptr<ScanSource> open_bag(const std::filesystem::path& path, const SourceOptions& options);

}  // namespace tilth
