// Writes ROS 1 bags (version 2.0) with their index, as `rosbag` and other readers expect them. Memory: one chunk of 768
// KiB (or one message, where it is larger).
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include <tilth/io/output_file.hpp>
#include <tilth/io/recording.hpp>

namespace tilth {

enum class BagCompression { none, lz4 };

class Rosbag1Writer {
 public:
  explicit Rosbag1Writer(const std::filesystem::path& path, BagCompression compression = BagCompression::none);

  /// The id that write() takes. `id` and `messages` of `connection` are not looked at.
  std::uint32_t add_connection(const Connection& connection);

  /// `stamp` [ns] since 1970, below 2^32 s. Messages may come in any order of time.
  void write(std::uint32_t connection, std::uint64_t stamp, std::span<const std::byte> bytes);

  /// Writes the index; only then does the file stand under its name.
  void close();

 private:
  struct Indexed {
    std::uint64_t stamp;
    std::uint32_t offset;
  };
  void write_bag_header(std::uint64_t index_position);
  void close_chunk();

  OutputFile file_;
  BagCompression compression_;
  std::vector<Connection> connections_;
  std::vector<bool> described_;                             // connections that stand in some chunk
  std::string chunk_;                                       // records of the open chunk
  std::map<std::uint32_t, std::vector<Indexed>> in_chunk_;  // its messages by connection
  std::vector<std::string> chunk_infos_;                    // records for the end of the bag
};

}  // namespace tilth
