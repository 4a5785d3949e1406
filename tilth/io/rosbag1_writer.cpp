#include <algorithm>
#include <limits>

#include <tilth/core/error.hpp>
#include <tilth/io/input_file.hpp>
#include <tilth/io/rosbag1_chunk.hpp>
#include <tilth/io/rosbag1_record.hpp>
#include <tilth/io/rosbag1_writer.hpp>

namespace tilth {
namespace {

using rosbag1::Op;
using rosbag1::raw;

constexpr std::size_t kChunkSize = 768 << 10;      // [bytes] as rosbag's own default
constexpr std::uint64_t kMaxMessage = 1000 << 20;  // [bytes] below the largest chunk that is read

std::string connection_record(const Connection& connection, std::uint32_t id) {
  const std::string description = rosbag1::fields_text({{"topic", connection.topic},
                                                        {"type", connection.type},
                                                        {"md5sum", connection.md5},
                                                        {"message_definition", connection.definition}});
  return rosbag1::record_text({{"op", raw(Op::connection)}, {"conn", raw(id)}, {"topic", connection.topic}},
                              description);
}

}  // namespace

Rosbag1Writer::Rosbag1Writer(const std::filesystem::path& path, BagCompression compression)
    : file_(path), compression_(compression) {
  file_.write(rosbag1::kMagic);
  write_bag_header(0);
}

std::uint32_t Rosbag1Writer::add_connection(const Connection& connection) {
  connections_.push_back(connection);
  described_.push_back(false);
  return std::uint32_t(connections_.size() - 1);
}

void Rosbag1Writer::write(std::uint32_t connection, std::uint64_t stamp, std::span<const std::byte> bytes) {
  const std::string where = "message of " + connections_.at(connection).topic;
  if (bytes.size() > kMaxMessage) throw Error(where, "has more than " + std::to_string(kMaxMessage) + " bytes");
  if (stamp / 1'000'000'000 > std::numeric_limits<std::uint32_t>::max())
    throw Error(where, "has a stamp beyond 2^32 s");
  if (!chunk_.empty() && chunk_.size() + bytes.size() > kChunkSize) close_chunk();
  if (!described_[connection]) chunk_ += connection_record(connections_[connection], connection);
  described_[connection] = true;
  in_chunk_[connection].push_back({stamp, std::uint32_t(chunk_.size())});
  const rosbag1::Fields header{{"op", raw(Op::message)}, {"conn", raw(connection)}, {"time", rosbag1::raw_time(stamp)}};
  chunk_ += rosbag1::record_text(header, as_text(bytes));
}

void Rosbag1Writer::close_chunk() {
  const std::uint64_t position = file_.size();
  const bool lz4 = compression_ == BagCompression::lz4;
  file_.write(rosbag1::record_text(
      {{"op", raw(Op::chunk)}, {"compression", lz4 ? "lz4" : "none"}, {"size", raw(std::uint32_t(chunk_.size()))}},
      lz4 ? rosbag1::pack_lz4(chunk_) : chunk_));
  std::uint64_t begin = std::numeric_limits<std::uint64_t>::max(), end = 0;
  std::string counts;
  for (const auto& [connection, messages] : in_chunk_) {
    std::string entries;
    for (const Indexed& message : messages) {
      begin = std::min(begin, message.stamp);
      end = std::max(end, message.stamp);
      entries += rosbag1::raw_time(message.stamp) + raw(message.offset);
    }
    const std::string count = raw(std::uint32_t(messages.size()));
    file_.write(rosbag1::record_text(
        {{"op", raw(Op::index)}, {"ver", raw(std::uint32_t{1})}, {"conn", raw(connection)}, {"count", count}},
        entries));
    counts += raw(connection) + count;
  }
  chunk_infos_.push_back(rosbag1::record_text({{"op", raw(Op::chunk_info)},
                                               {"ver", raw(std::uint32_t{1})},
                                               {"chunk_pos", raw(position)},
                                               {"start_time", rosbag1::raw_time(begin)},
                                               {"end_time", rosbag1::raw_time(end)},
                                               {"count", raw(std::uint32_t(in_chunk_.size()))}},
                                              counts));
  chunk_.clear();
  in_chunk_.clear();
}

void Rosbag1Writer::write_bag_header(std::uint64_t index_position) {
  const rosbag1::Fields header{{"op", raw(Op::bag_header)},
                               {"index_pos", raw(index_position)},
                               {"conn_count", raw(std::uint32_t(connections_.size()))},
                               {"chunk_count", raw(std::uint32_t(chunk_infos_.size()))}};
  const std::size_t bare = rosbag1::record_text(header, "").size();
  const std::string text = rosbag1::record_text(header, std::string(rosbag1::kBagHeaderSize - bare, ' '));
  if (file_.size() == rosbag1::kMagic.size())
    file_.write(text);
  else
    file_.write_at(rosbag1::kMagic.size(), std::as_bytes(std::span(text)));
}

void Rosbag1Writer::close() {
  if (!chunk_.empty()) close_chunk();
  const std::uint64_t index_position = file_.size();
  for (std::uint32_t id = 0; id < connections_.size(); ++id) file_.write(connection_record(connections_[id], id));
  for (const std::string& info : chunk_infos_) file_.write(info);
  write_bag_header(index_position);
  file_.close();
}

}  // namespace tilth
