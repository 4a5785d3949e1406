// ROS 2 bags stored by sqlite3, read in the order of their stamps: a .db3 file, or a folder of one or more of them with
// the metadata.yaml that lists them. Messages may be compressed one by one (zstd), or the files as a whole (.db3.zstd),
// which are unpacked into the temporary folder. Memory: 24 bytes a message and one message.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <tilth/io/recording.hpp>

struct sqlite3;

namespace tilth {

class Rosbag2Reader {
 public:
  /// Throws Error where a file cannot be read or is no such bag.
  explicit Rosbag2Reader(const std::filesystem::path& path);
  ~Rosbag2Reader();
  Rosbag2Reader(Rosbag2Reader&&) noexcept;

  const std::vector<Connection>& connections() const { return connections_; }

  /// Only these topics from now on, from the first message. Throws Error naming a topic that the bag does not have.
  void select(const std::vector<std::string>& topics);

  /// The next message that can be read, in CDR; nothing at the end.
  std::optional<Message> next();

  std::string problem() const { return problem_; }  ///< what is damaged; empty where all is well (so far)

 private:
  struct Database;
  struct Entry {
    std::uint64_t stamp;  // [ns]
    std::int64_t row;
    std::uint32_t connection;
    std::uint32_t database;
  };
  void add(const std::filesystem::path& file);
  std::optional<Message> read(const Entry& entry);

  std::string name_;
  std::vector<std::unique_ptr<Database>> databases_;
  std::vector<Connection> connections_;
  std::vector<Entry> messages_, selected_;
  std::size_t next_ = 0;
  std::string problem_;
};

/// A .db3 or .db3.zstd file, or a folder that holds a ROS 2 bag, of .mcap files too.
bool is_rosbag2(const std::filesystem::path& path);

}  // namespace tilth
