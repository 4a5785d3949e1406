// Writes MCAP recordings (mcap.dev, version 0) of ROS 2 messages, in chunks of Zstandard and with their index, as
// Foxglove and ROS 2 expect them. Memory: one chunk of 1 MiB (or one message, where it is larger), 16 bytes a message.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include <tilth/io/output_file.hpp>
#include <tilth/io/recording.hpp>

namespace tilth {

class McapWriter {
 public:
  explicit McapWriter(const std::filesystem::path& path);

  /// The id that write() takes. Of `connection` counts the topic, the type ("nav_msgs/msg/Path") and its definition
  /// (ros2msg); messages are in CDR.
  std::uint32_t add_connection(const Connection& connection);

  /// `stamp` [ns] since 1970. Messages may come in any order of time.
  void write(std::uint32_t connection, std::uint64_t stamp, std::span<const std::byte> bytes);

  /// Writes the index; only then does the file stand under its name.
  void close();

 private:
  using Bytes = std::vector<std::byte>;
  struct Indexed {
    std::uint64_t stamp, offset;
  };
  struct ChunkEntry {
    std::uint64_t begin, end;                        // [ns]
    std::uint64_t position, length;                  // of its record
    std::map<std::uint16_t, std::uint64_t> indices;  // positions of the records about its messages
    std::uint64_t index_length, packed, plain;
  };
  void close_chunk();
  void write_summary(std::uint64_t position);
  Bytes statistics() const;

  OutputFile file_;
  std::vector<Bytes> descriptions_;    // schema and channel of each connection, as records
  std::vector<std::uint64_t> counts_;  // messages of each
  Bytes chunk_;                        // records of the open chunk
  std::map<std::uint16_t, std::vector<Indexed>> in_chunk_;
  std::vector<ChunkEntry> chunks_;
};

}  // namespace tilth
