// The chunks of a ROS 1 bag: packed records, stored plain, as bz2 or as an LZ4 frame. O(bytes).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <tilth/io/input_file.hpp>
#include <tilth/io/rosbag1_record.hpp>

namespace tilth::rosbag1 {

inline constexpr std::uint64_t kMaxChunk = std::uint64_t{1} << 30;  ///< [bytes] unpacked; more is refused

struct Chunk {
  std::uint64_t position = 0;    ///< of its record in the file
  std::vector<std::byte> bytes;  ///< unpacked, up to the damage
  std::string problem;           ///< empty where the chunk is whole
};

/// The chunk of `record`, as far as it can be unpacked. A chunk that was never closed (no size stated) is taken to fill
/// the rest of the file. Never holds more than the file or kMaxChunk, whatever sizes are stated.
Chunk read_chunk(const InputFile& file, const Record& record);

/// `bytes` as one LZ4 frame of independent blocks, which ROS asks for.
std::string pack_lz4(std::string_view bytes);

}  // namespace tilth::rosbag1
