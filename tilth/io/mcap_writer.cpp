#include <algorithm>
#include <limits>
#include <utility>

#include <tilth/core/error.hpp>
#include <tilth/io/mcap_record.hpp>
#include <tilth/io/mcap_writer.hpp>
#include <tilth/io/unpack.hpp>

namespace tilth {
namespace {

using mcap::RecordWriter;
using Bytes = std::vector<std::byte>;

constexpr std::size_t kChunkSize = 1 << 20;  // [bytes]
constexpr std::string_view kCompression = "zstd";

void append(Bytes& bytes, const Bytes& more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
}

}  // namespace

McapWriter::McapWriter(const std::filesystem::path& path) : file_(path) {
  file_.write(mcap::magic());
  file_.write(RecordWriter(mcap::kHeader).text("ros2").text("tilth").take());
}

std::uint32_t McapWriter::add_connection(const Connection& connection) {
  const std::size_t id = counts_.size() + 1;
  if (id > std::numeric_limits<std::uint16_t>::max()) throw Error("topic " + connection.topic, "is one too many");
  Bytes both = RecordWriter(mcap::kSchema)
                   .number(2, id)
                   .text(connection.type)
                   .text("ros2msg")
                   .text(connection.definition)
                   .take();
  append(both, RecordWriter(mcap::kChannel)
                   .number(2, id)
                   .number(2, id)
                   .text(connection.topic)
                   .text("cdr")
                   .number(4, 0)  // no metadata
                   .take());
  append(chunk_, both);
  descriptions_.push_back(std::move(both));
  counts_.push_back(0);
  return std::uint32_t(id - 1);
}

void McapWriter::write(std::uint32_t connection, std::uint64_t stamp, std::span<const std::byte> bytes) {
  if (bytes.size() > kMostUnpacked / 2)
    throw Error("message", "of " + std::to_string(bytes.size()) + " bytes is too long for a recording");
  if (!in_chunk_.empty() && chunk_.size() + bytes.size() > kChunkSize) close_chunk();
  const auto id = std::uint16_t(connection + 1);
  in_chunk_[id].push_back({stamp, chunk_.size()});
  append(chunk_, RecordWriter(mcap::kMessage)
                     .number(2, id)
                     .number(4, counts_.at(connection)++)
                     .number(8, stamp)
                     .number(8, stamp)
                     .bytes(bytes)
                     .take());
}

void McapWriter::close_chunk() {
  ChunkEntry entry{std::numeric_limits<std::uint64_t>::max(), 0, file_.size(), 0, {}, 0, 0, chunk_.size()};
  for (const auto& [id, messages] : in_chunk_) {
    for (const Indexed& message : messages) {
      entry.begin = std::min(entry.begin, message.stamp);
      entry.end = std::max(entry.end, message.stamp);
    }
  }
  const Bytes packed = pack_zstd(chunk_);
  entry.packed = packed.size();
  file_.write(RecordWriter(mcap::kChunk)
                  .number(8, entry.begin)
                  .number(8, entry.end)
                  .number(8, chunk_.size())
                  .number(4, 0)  // no checksum
                  .text(kCompression)
                  .number(8, packed.size())
                  .bytes(packed)
                  .take());
  entry.length = file_.size() - entry.position;
  for (const auto& [id, messages] : in_chunk_) {
    entry.indices[id] = file_.size();
    RecordWriter index(mcap::kMessageIndex);
    index.number(2, id).number(4, 16 * messages.size());
    for (const Indexed& message : messages) index.number(8, message.stamp).number(8, message.offset);
    file_.write(index.take());
  }
  entry.index_length = file_.size() - entry.position - entry.length;
  chunks_.push_back(std::move(entry));
  chunk_.clear();
  in_chunk_.clear();
}

std::vector<std::byte> McapWriter::statistics() const {
  std::uint64_t messages = 0, begin = std::numeric_limits<std::uint64_t>::max(), end = 0;
  for (const std::uint64_t count : counts_) messages += count;
  for (const ChunkEntry& chunk : chunks_) begin = std::min(begin, chunk.begin), end = std::max(end, chunk.end);
  RecordWriter record(mcap::kStatistics);
  record.number(8, messages).number(2, counts_.size()).number(4, counts_.size()).number(4, 0).number(4, 0);
  record.number(4, chunks_.size()).number(8, messages > 0 ? begin : 0).number(8, end);
  record.number(4, 10 * counts_.size());
  for (std::size_t i = 0; i < counts_.size(); ++i) record.number(2, i + 1).number(8, counts_[i]);
  return record.take();
}

void McapWriter::write_summary(std::uint64_t position) {
  for (const Bytes& description : descriptions_) file_.write(description);
  for (const ChunkEntry& chunk : chunks_) {
    RecordWriter record(mcap::kChunkIndex);
    record.number(8, chunk.begin).number(8, chunk.end).number(8, chunk.position).number(8, chunk.length);
    record.number(4, 10 * chunk.indices.size());
    for (const auto& [id, at] : chunk.indices) record.number(2, id).number(8, at);
    record.number(8, chunk.index_length).text(kCompression).number(8, chunk.packed).number(8, chunk.plain);
    file_.write(record.take());
  }
  file_.write(statistics());
  file_.write(RecordWriter(mcap::kFooter).number(8, position).number(8, 0).number(4, 0).take());
  file_.write(mcap::magic());
}

void McapWriter::close() {
  if (!in_chunk_.empty()) close_chunk();
  file_.write(RecordWriter(mcap::kDataEnd).number(4, 0).take());
  write_summary(file_.size());
  file_.close();
}

}  // namespace tilth
