#include <algorithm>
#include <utility>

#include <tilth/core/error.hpp>
#include <tilth/io/rosbag1.hpp>
#include <tilth/io/rosbag1_record.hpp>

namespace tilth {
namespace {

constexpr std::size_t kMaxHeldBytes = std::size_t{64} << 20;

}  // namespace

Rosbag1Reader::Rosbag1Reader(InputFile file)
    : file_(std::move(file)), index_(rosbag1::index_bag(file_)), selected_(index_.messages), problem_(index_.problem) {}

void Rosbag1Reader::select(const std::vector<std::string>& topics) {
  std::vector<std::uint32_t> wanted;
  std::string known;
  for (const Connection& connection : index_.connections) {
    known += (known.empty() ? "" : ", ") + connection.topic;
    if (std::count(topics.begin(), topics.end(), connection.topic) > 0) wanted.push_back(connection.id);
  }
  for (const std::string& topic : topics) {
    const bool found = std::any_of(index_.connections.begin(), index_.connections.end(),
                                   [&](const Connection& connection) { return connection.topic == topic; });
    if (!found) throw Error(file_.name(), "has no topic " + topic + "; it has: " + (known.empty() ? "none" : known));
  }
  selected_.clear();
  std::copy_if(index_.messages.begin(), index_.messages.end(), std::back_inserter(selected_),
               [&](const auto& entry) { return std::binary_search(wanted.begin(), wanted.end(), entry.connection); });
  next_ = 0;
}

std::optional<Message> Rosbag1Reader::next() {
  while (next_ < selected_.size()) {
    std::optional<Message> message = read(selected_[next_++]);
    if (message) return message;
    ++lost_;
  }
  return std::nullopt;
}

std::string Rosbag1Reader::problem() const {
  return lost_ == 0 ? problem_ : problem_ + " (" + std::to_string(lost_) + " messages lost)";
}

std::optional<Message> Rosbag1Reader::read(const rosbag1::MessageEntry& entry) {
  const bool in_chunk = entry.chunk != rosbag1::kNoChunk;
  const rosbag1::Chunk* chunk = in_chunk ? &chunk_at(entry.chunk) : nullptr;
  const std::span<const std::byte> bytes =
      chunk ? std::span<const std::byte>(chunk->bytes) : std::span<const std::byte>();
  const InputFile inside(bytes, file_.name());
  const InputFile& source = in_chunk ? inside : file_;
  const std::optional<rosbag1::Record> record = rosbag1::record_at(source, entry.offset);
  const bool found = record && record->is(rosbag1::Op::message) && record->end() <= source.size() &&
                     record->field<std::uint32_t>("conn") == entry.connection;
  if (found) return Message{entry.connection, entry.stamp, source.read(record->data_position, record->data_size)};
  if (problem_.empty()) {
    const std::string reason = chunk && !chunk->problem.empty() ? chunk->problem : "its index points at no message";
    problem_ = "chunk at byte " + std::to_string(entry.chunk) + ": " + reason;
  }
  return std::nullopt;
}

const rosbag1::Chunk& Rosbag1Reader::chunk_at(std::uint64_t position) {
  const auto held = std::find_if(chunks_.begin(), chunks_.end(), [&](const auto& c) { return c.position == position; });
  if (held != chunks_.end()) {
    chunks_.splice(chunks_.begin(), chunks_, held);
    return chunks_.front();
  }
  std::size_t bytes = 0;
  for (const rosbag1::Chunk& chunk : chunks_) bytes += chunk.bytes.size();
  for (; !chunks_.empty() && bytes > kMaxHeldBytes; chunks_.pop_back()) bytes -= chunks_.back().bytes.size();
  const std::optional<rosbag1::Record> record = rosbag1::record_at(file_, position);
  chunks_.push_front(record ? rosbag1::read_chunk(file_, *record) : rosbag1::Chunk{position, {}, "it is gone"});
  return chunks_.front();
}

}  // namespace tilth
