// ROS 1 bags (version 2.0), read as a stream in the order of their stamps. Our own reader, because ROS's library
// refuses bags that were never indexed or are cut, cannot go on after damage, and drags in boost, pluginlib and gpgme.
// Memory: 32 bytes a message, and of the unpacked chunks the last used ones up to 64 MiB (one chunk, where it is
// larger), so that chunks which overlap in time are not unpacked again and again.
#pragma once

#include <filesystem>
#include <list>
#include <optional>
#include <string>
#include <vector>

#include <tilth/io/input_file.hpp>
#include <tilth/io/recording.hpp>
#include <tilth/io/rosbag1_chunk.hpp>
#include <tilth/io/rosbag1_index.hpp>

namespace tilth {

class Rosbag1Reader {
 public:
  /// Throws Error where the file cannot be read or is no bag. A damaged bag opens: see truncated() and problem().
  explicit Rosbag1Reader(const std::filesystem::path& path) : Rosbag1Reader(InputFile(path)) {}
  explicit Rosbag1Reader(InputFile file);

  const std::vector<Connection>& connections() const { return index_.connections; }

  /// Only these topics from now on, from the first message. Throws Error naming a topic that the bag does not have.
  void select(const std::vector<std::string>& topics);

  /// The next message that can be read; nothing at the end. Messages lost to damage are counted in problem().
  std::optional<Message> next();

  bool truncated() const { return index_.truncated; }  ///< the recording was not closed, or the file is cut
  std::string problem() const;                         ///< what is damaged; empty where all is well (so far)

 private:
  std::optional<Message> read(const rosbag1::MessageEntry& entry);
  const rosbag1::Chunk& chunk_at(std::uint64_t position);

  InputFile file_;
  rosbag1::BagIndex index_;
  std::vector<rosbag1::MessageEntry> selected_;
  std::size_t next_ = 0, lost_ = 0;
  std::string problem_;
  std::list<rosbag1::Chunk> chunks_;  // last used first
};

}  // namespace tilth
