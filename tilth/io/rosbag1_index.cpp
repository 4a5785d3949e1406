#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

#include <tilth/core/error.hpp>
#include <tilth/io/rosbag1_chunk.hpp>
#include <tilth/io/rosbag1_index.hpp>
#include <tilth/io/rosbag1_record.hpp>

namespace tilth::rosbag1 {
namespace {

constexpr std::size_t kIndexEntry = 12;  // [bytes] u32 seconds, u32 nanoseconds, u32 offset

void check_magic(const InputFile& file) {
  const std::vector<std::byte> bytes = file.read(0, kMagic.size());
  const std::string_view text = as_text(bytes);
  if (text.empty()) throw Error(file.name(), "is empty (0 bytes)");
  if (text == kMagic) return;
  if (text.starts_with("#ROSBAG V")) throw Error(file.name(), "is a bag of a version other than 2.0");
  throw Error(file.name(), "is no ROS 1 bag: it does not begin with #ROSBAG V2.0");
}

class Walk {
 public:
  explicit Walk(const InputFile& file) : file_(file) {}

  BagIndex run() {
    std::uint64_t position = kMagic.size();
    while (position < file_.size()) {
      const std::optional<Record> record = record_at(file_, position);
      const bool broken = !record || (record->end() > file_.size() && !record->is(Op::chunk));
      if (broken) {
        break_off("breaks off at byte " + std::to_string(position) + " of " + std::to_string(file_.size()));
        break;
      }
      take(*record);
      position = record->end();
    }
    if (chunk_) close_chunk(false);
    check_end();
    return result();
  }

 private:
  void take(const Record& record) {
    if (record.is(Op::index)) return take_index(record);
    if (chunk_) close_chunk(true);
    if (record.is(Op::bag_header)) take_bag_header(record);
    if (index_position_ > 0 && record.position >= index_position_) ++closing_;
    if (record.is(Op::connection)) take_connection(file_, record);
    if (record.is(Op::message)) take_message(record, kNoChunk, index_.messages);
    if (record.is(Op::chunk)) chunk_ = record;
  }

  void take_bag_header(const Record& record) {
    index_position_ = record.field<std::uint64_t>("index_pos").value_or(0);
    closing_stated_ = std::uint64_t{record.field<std::uint32_t>("conn_count").value_or(0)} +
                      record.field<std::uint32_t>("chunk_count").value_or(0);
  }

  void take_connection(const InputFile& from, const Record& record) {
    const std::vector<std::byte> data = from.read(record.data_position, record.data_size);
    const std::optional<Connection> connection = connection_of(record, as_text(data));
    if (connection)
      connections_.emplace(connection->id, *connection);
    else
      note("connection record at byte " + std::to_string(record.position) + " lacks its topic or type");
  }

  static void take_message(const Record& record, std::uint64_t chunk, std::vector<MessageEntry>& messages) {
    const std::optional<std::uint64_t> stamp = nanoseconds(record.text("time"));
    const std::optional<std::uint32_t> connection = record.field<std::uint32_t>("conn");
    if (stamp && connection) messages.push_back({*stamp, chunk, record.position, *connection});
  }

  // The index of one connection in the chunk just before.
  void take_index(const Record& record) {
    const std::optional<std::uint32_t> connection = record.field<std::uint32_t>("conn");
    const std::uint64_t count = record.field<std::uint32_t>("count").value_or(0);
    if (!chunk_ || !connection || record.field<std::uint32_t>("ver") != 1U || count * kIndexEntry != record.data_size) {
      index_sound_ = false;
      return;
    }
    const std::vector<std::byte> data = file_.read(record.data_position, record.data_size);
    for (std::string_view text = as_text(data); !text.empty(); text.remove_prefix(kIndexEntry)) {
      indexed_.push_back({*nanoseconds(text), chunk_->position, *number<std::uint32_t>(text.substr(8)), *connection});
    }
  }

  // A chunk's index is complete only if another record follows it.
  void close_chunk(bool followed) {
    const auto is_known = [&](const MessageEntry& entry) { return connections_.contains(entry.connection); };
    const bool indexed = followed && index_sound_ && !indexed_.empty();
    if (!indexed || !std::all_of(indexed_.begin(), indexed_.end(), is_known)) walk_chunk(*chunk_, !indexed);
    if (indexed) index_.messages.insert(index_.messages.end(), indexed_.begin(), indexed_.end());
    chunk_.reset();
    indexed_.clear();
    index_sound_ = true;
  }

  void walk_chunk(const Record& record, bool with_messages) {
    const Chunk chunk = read_chunk(file_, record);
    const InputFile inside(chunk.bytes, file_.name());
    std::uint64_t position = 0;
    while (position < inside.size()) {
      const std::optional<Record> found = record_at(inside, position);
      if (!found || found->end() > inside.size()) break;
      if (found->is(Op::connection)) take_connection(inside, *found);
      if (found->is(Op::message) && with_messages) take_message(*found, record.position, index_.messages);
      position = found->end();
    }
    const std::string where = "chunk at byte " + std::to_string(record.position) + ": ";
    if (!chunk.problem.empty())
      note(where + chunk.problem);
    else if (position < inside.size())
      note(where + "no record at its byte " + std::to_string(position));
    index_.truncated |= record.end() > file_.size();
  }

  void check_end() {
    if (index_position_ == 0) {
      break_off("has no index: the recording was not closed");
    } else if (closing_ < closing_stated_) {
      break_off("ends at byte " + std::to_string(file_.size()) + ", within or before its index at byte " +
                std::to_string(index_position_));
    }
  }

  BagIndex result() {
    std::erase_if(index_.messages, [&](const MessageEntry& entry) { return !connections_.contains(entry.connection); });
    for (const MessageEntry& entry : index_.messages) ++connections_.at(entry.connection).messages;
    for (const auto& [id, connection] : connections_) index_.connections.push_back(connection);
    const auto order = [](const MessageEntry& e) { return std::tuple(e.stamp, e.chunk, e.offset); };
    std::sort(index_.messages.begin(), index_.messages.end(),
              [&](const MessageEntry& a, const MessageEntry& b) { return order(a) < order(b); });
    return std::move(index_);
  }

  void break_off(const std::string& problem) {
    index_.truncated = true;
    note(problem);
  }
  void note(const std::string& problem) {
    if (index_.problem.empty()) index_.problem = problem;
  }

  const InputFile& file_;
  BagIndex index_;
  std::map<std::uint32_t, Connection> connections_;
  std::uint64_t index_position_ = 0;
  std::uint64_t closing_ = 0, closing_stated_ = 0;  // records at the bag's end: connections and chunk infos
  std::optional<Record> chunk_;                     // the chunk whose index may still follow
  std::vector<MessageEntry> indexed_;               // what that index says
  bool index_sound_ = true;
};

}  // namespace

BagIndex index_bag(const InputFile& file) {
  check_magic(file);
  return Walk(file).run();
}

}  // namespace tilth::rosbag1
