// Where every message of a ROS 1 bag lies. One walk over the record headers, skipping the data, finds it without the
// index at the bag's end, so that a recording which crashed or was cut is read up to the break. Chunks are unpacked
// only where their own index is missing, or for a connection not seen before. O(records); 32 bytes a message.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <tilth/io/input_file.hpp>
#include <tilth/io/recording.hpp>

namespace tilth::rosbag1 {

inline constexpr std::uint64_t kNoChunk = std::numeric_limits<std::uint64_t>::max();

struct MessageEntry {
  std::uint64_t stamp = 0;   ///< [ns]
  std::uint64_t chunk = 0;   ///< position of the chunk's record, or kNoChunk
  std::uint64_t offset = 0;  ///< of the message's record in the unpacked chunk, without chunk in the file
  std::uint32_t connection = 0;
};

struct BagIndex {
  std::vector<Connection> connections;  ///< by id
  std::vector<MessageEntry> messages;   ///< by stamp, equal stamps as in the file
  bool truncated = false;               ///< the recording was not closed, or the file is cut
  std::string problem;                  ///< the first damage found; empty where there is none
};

/// Throws Error where the file is no ROS 1 bag at all.
BagIndex index_bag(const InputFile& file);

}  // namespace tilth::rosbag1
