// The metadata.yaml of a ROS 2 bag, as far as reading needs it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tilth {

/// The files that a metadata.yaml lists, without their folders. Throws Error calling it `name` where it is damaged, too
/// long, or the bag is stored otherwise.
std::vector<std::string> parse_rosbag2_metadata(const std::string& text, const std::string& name);

/// The files of the bag in `folder`, in order: those its metadata.yaml lists, else every .db3 and .mcap, packed or not.
/// Throws Error where there are none, the metadata is damaged, or the bag is stored otherwise.
std::vector<std::filesystem::path> rosbag2_files(const std::filesystem::path& folder);

}  // namespace tilth
