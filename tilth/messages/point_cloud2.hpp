// sensor_msgs/PointCloud2 as ROS 1 (little-endian, packed, strings and arrays behind a u32 count) and ROS 2 (CDR) have
// it. O(bytes).
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <tilth/core/point_records.hpp>
#include <tilth/messages/ros_message.hpp>

namespace tilth {

struct PointCloud2 {
  double stamp = 0.0;  ///< [s] of the header
  std::string frame_id;
  PointRecords records;  ///< height x width of them, rows without their padding
};

inline constexpr std::string_view kPointCloud2Type = "sensor_msgs/PointCloud2";
inline constexpr std::string_view kPointCloud2Md5 = "1158d486dd51d683ce2f1be655c3c181";
extern const std::string_view kPointCloud2Definition;  ///< text of the message and of those it holds

/// Throws Error naming the field of the message that contradicts the bytes there are. Of fields with count > 1 the
/// first element; a row_step of 0 stands for rows without padding.
PointCloud2 parse_point_cloud2(std::span<const std::byte> message, Serialization serialization = Serialization::ros1);

/// One row of records. Throws Error where a field has a type that the message knows none for (64 bit integers), where
/// the cloud is longer than 2^32 bytes, or the stamp lies outside [0, 2^32) s.
std::vector<std::byte> serialize_point_cloud2(const PointCloud2& cloud,
                                              Serialization serialization = Serialization::ros1);

}  // namespace tilth
