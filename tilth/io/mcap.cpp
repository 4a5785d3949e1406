#include <algorithm>
#include <utility>

#include <tilth/core/error.hpp>
#include <tilth/io/mcap.hpp>
#include <tilth/io/mcap_record.hpp>
#include <tilth/io/unpack.hpp>
#include <tilth/io/unpacked_file.hpp>

namespace tilth {
namespace {

/// The records of a chunk, unpacked; nothing where it is damaged.
std::optional<std::vector<std::byte>> records_of(std::span<const std::byte> chunk) {
  mcap::Body body(chunk);
  body.bytes(mcap::kChunkHeader);
  const std::string compression = body.text();
  const std::span<const std::byte> packed = body.bytes(body.number(8));
  return body.ok() ? unpack(compression, packed) : std::nullopt;
}

}  // namespace

/// An unpacked copy is open when its name is taken away.
McapReader::McapReader(const std::filesystem::path& path) : McapReader(InputFile(UnpackedFile(path).path())) {}

McapReader::McapReader(InputFile file) : file_(std::move(file)) {
  if (!mcap::begins_file(file_.read(0, mcap::kMagicSize))) throw Error(file_.name(), "is no MCAP file");
  index();
  std::stable_sort(messages_.begin(), messages_.end(),
                   [](const Entry& a, const Entry& b) { return a.stamp < b.stamp; });
  selected_ = messages_;
}

void McapReader::index() {
  std::uint64_t position = mcap::kMagicSize;
  while (position < file_.size()) {
    const std::vector<std::byte> header = file_.read(position, mcap::kRecordHeader);
    mcap::Body fields(header);
    const auto op = std::uint8_t(fields.number(1));
    const std::uint64_t size = fields.number(8);
    const std::uint64_t body = position + mcap::kRecordHeader;
    if (!fields.ok() || size > file_.size() - body) return note("breaks off at byte " + std::to_string(position));
    if (op == mcap::kDataEnd) return;
    if (op == mcap::kChunk) index_chunk(body, size);
    if (op == mcap::kSchema || op == mcap::kChannel || op == mcap::kMessage) take(op, file_.read(body, size), 0, body);
    position = body + size;
  }
  note("was not closed");
}

void McapReader::index_chunk(std::uint64_t position, std::uint64_t size) {
  const auto records = records_of(file_.read(position, size));
  if (!records) return note("the chunk at byte " + std::to_string(position) + " is damaged");
  mcap::Body body(*records);
  while (!body.rest().empty()) {
    const auto op = std::uint8_t(body.number(1));
    const std::span<const std::byte> record = body.bytes(body.number(8));
    if (!body.ok()) return note("the chunk at byte " + std::to_string(position) + " breaks off");
    take(op, record, position, std::uint64_t(record.data() - records->data()));
  }
}

/// `at` is where the body begins, in the chunk or the file.
void McapReader::take(std::uint8_t op, std::span<const std::byte> record, std::uint64_t chunk, std::uint64_t at) {
  mcap::Body body(record);
  const auto id = std::uint16_t(body.number(2));
  if (op == mcap::kSchema) schemas_[id] = body.text();
  if (op == mcap::kChannel && !channels_.contains(id)) {
    const auto schema = std::uint16_t(body.number(2));
    Connection connection{std::uint32_t(connections_.size()), body.text(), schemas_[schema], "", "", 0};
    connection.encoding = body.text();
    if (!body.ok()) return note("a channel is damaged");
    channels_[id] = connection.id;
    connections_.push_back(std::move(connection));
  }
  if (op != mcap::kMessage) return;
  body.number(4);  // sequence
  const std::uint64_t stamp = body.number(8);
  body.number(8);  // publish time
  const auto channel = channels_.find(id);
  if (!body.ok() || channel == channels_.end()) return note("a message is damaged");
  messages_.push_back({stamp, chunk, at + mcap::kMessageHeader, std::uint32_t(body.rest().size()), channel->second});
  ++connections_[channel->second].messages;
}

void McapReader::note(const std::string& problem) {
  if (problem_.empty()) problem_ = problem;
}

void McapReader::select(const std::vector<std::string>& topics) {
  for (const std::string& topic : topics) {
    if (std::none_of(connections_.begin(), connections_.end(), [&](const auto& c) { return c.topic == topic; }))
      throw Error(file_.name(), "has no topic " + topic);
  }
  selected_.clear();
  std::copy_if(messages_.begin(), messages_.end(), std::back_inserter(selected_), [&](const Entry& entry) {
    return std::count(topics.begin(), topics.end(), connections_[entry.connection].topic) > 0;
  });
  next_ = 0;
}

std::optional<Message> McapReader::next() {
  while (next_ < selected_.size()) {
    const Entry& entry = selected_[next_++];
    std::optional<std::vector<std::byte>> bytes = read(entry);
    // rosbag2 can pack each message by itself and says so in its metadata.yaml only; CDR never begins like that.
    const bool packed = bytes && connections_[entry.connection].encoding == "cdr" && is_zstd(*bytes);
    if (packed) bytes = unpack("zstd", *bytes);
    if (bytes) return Message{entry.connection, entry.stamp, std::move(*bytes)};
    if (packed) note("a packed message is damaged");
  }
  return std::nullopt;
}

std::optional<std::vector<std::byte>> McapReader::read(const Entry& entry) {
  if (entry.chunk == 0) return file_.read(entry.at, entry.size);
  hold(entry.chunk);
  if (entry.at + entry.size > held_bytes_.size()) return std::nullopt;
  const auto begin = held_bytes_.begin() + std::ptrdiff_t(entry.at);
  return std::vector<std::byte>{begin, begin + std::ptrdiff_t(entry.size)};
}

void McapReader::hold(std::uint64_t chunk) {
  if (held_ == chunk) return;
  const std::vector<std::byte> header = file_.read(chunk - mcap::kRecordHeader, mcap::kRecordHeader);
  mcap::Body fields(header);
  fields.number(1);
  held_bytes_ = records_of(file_.read(chunk, fields.number(8))).value_or(std::vector<std::byte>{});
  held_ = chunk;
  if (held_bytes_.empty()) note("the chunk at byte " + std::to_string(chunk) + " cannot be read again");
}

}  // namespace tilth
