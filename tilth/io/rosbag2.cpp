#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <sqlite3.h>
#include <tuple>
#include <utility>

#include <tilth/core/error.hpp>
#include <tilth/io/file_kind.hpp>
#include <tilth/io/rosbag2.hpp>
#include <tilth/io/rosbag2_metadata.hpp>
#include <tilth/io/unpack.hpp>
#include <tilth/io/unpacked_file.hpp>

namespace tilth {
namespace {

constexpr int kLongestMessage = 1 << 28;  // [bytes]

/// The path as part of a URI, in which only plain characters stand for themselves.
std::string uri_of(const std::filesystem::path& path, const std::string& query) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./";
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string uri = "file:";
  for (const char c : std::filesystem::absolute(path).string()) {
    const auto byte = static_cast<unsigned char>(c);
    if (kPlain.find(c) != std::string_view::npos)
      uri += c;
    else
      uri += {'%', kDigits[byte >> 4], kDigits[byte & 15]};
  }
  return uri + "?" + query;
}

std::string text_at(sqlite3_stmt* row, int column) {
  const unsigned char* text = sqlite3_column_text(row, column);
  return text == nullptr ? std::string{} : reinterpret_cast<const char*>(text);
}

}  // namespace

struct Rosbag2Reader::Database {
  using Statement = std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)>;

  std::string name;
  UnpackedFile file;
  std::unique_ptr<sqlite3, int (*)(sqlite3*)> handle{nullptr, sqlite3_close};
  Statement by_row{nullptr, sqlite3_finalize};

  /// Opens so that nothing is written, also where a recorder left its journal mode in a folder that is read-only.
  explicit Database(const std::filesystem::path& path) : name(path.string()), file(path) {
    if (!std::filesystem::is_regular_file(path)) throw Error(name, "no such file");
    if (!open(uri_of(file.path(), "mode=ro")) && !open(uri_of(file.path(), "immutable=1")))
      throw Error(name, "is no sqlite3 database that can be read: " + reason());
    sqlite3_limit(handle.get(), SQLITE_LIMIT_LENGTH, kLongestMessage);
    by_row = prepare("SELECT data FROM messages WHERE rowid = ?");
  }

  bool open(const std::string& uri) {
    sqlite3* raw = nullptr;
    const int result = sqlite3_open_v2(uri.c_str(), &raw, SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr);
    handle.reset(raw);
    return result == SQLITE_OK &&
           sqlite3_exec(raw, "SELECT 1 FROM sqlite_master", nullptr, nullptr, nullptr) == SQLITE_OK;
  }

  std::string reason() const { return sqlite3_errmsg(handle.get()); }

  Statement prepare(const char* query) const {
    sqlite3_stmt* raw = nullptr;
    if (sqlite3_prepare_v2(handle.get(), query, -1, &raw, nullptr) != SQLITE_OK)
      throw Error(name, "is no ROS 2 bag: " + reason());
    return {raw, sqlite3_finalize};
  }

  /// Calls f for every row; what went wrong, or nothing.
  template <class F>
  std::string each(const char* query, const F& f) const {
    const Statement rows = prepare(query);
    int result = sqlite3_step(rows.get());
    for (; result == SQLITE_ROW; result = sqlite3_step(rows.get())) f(rows.get());
    return result == SQLITE_DONE ? std::string{} : name + ": " + reason();
  }
};

Rosbag2Reader::Rosbag2Reader(const std::filesystem::path& path) : name_(path.string()) {
  if (!std::filesystem::is_directory(path)) {
    add(path);
  } else {
    for (const std::filesystem::path& file : rosbag2_files(path)) add(file);
  }
  std::sort(messages_.begin(), messages_.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.stamp, a.database, a.row) < std::tie(b.stamp, b.database, b.row);
  });
  selected_ = messages_;
}

Rosbag2Reader::~Rosbag2Reader() = default;
Rosbag2Reader::Rosbag2Reader(Rosbag2Reader&&) noexcept = default;

void Rosbag2Reader::add(const std::filesystem::path& file) {
  const auto& database = *databases_.emplace_back(std::make_unique<Database>(file));
  std::map<std::int64_t, std::uint32_t> ids;  // of the file's topics -> connections
  std::string damage = database.each("SELECT id, name, type, serialization_format FROM topics", [&](sqlite3_stmt* row) {
    if (text_at(row, 3) != "cdr") return;
    const auto id = std::uint32_t(connections_.size());
    ids[sqlite3_column_int64(row, 0)] = id;
    connections_.push_back({id, text_at(row, 1), text_at(row, 2), "", "", 0, "cdr"});
  });
  const std::string more = database.each("SELECT rowid, topic_id, timestamp FROM messages", [&](sqlite3_stmt* row) {
    const auto id = ids.find(sqlite3_column_int64(row, 1));
    if (id == ids.end()) return;
    const auto stamp = std::uint64_t(std::max<std::int64_t>(0, sqlite3_column_int64(row, 2)));
    messages_.push_back({stamp, sqlite3_column_int64(row, 0), id->second, std::uint32_t(databases_.size() - 1)});
    ++connections_[id->second].messages;
  });
  if (problem_.empty()) problem_ = damage.empty() ? more : damage;
}

void Rosbag2Reader::select(const std::vector<std::string>& topics) {
  const auto wanted = [&](const Connection& connection) {
    return std::count(topics.begin(), topics.end(), connection.topic) > 0;
  };
  for (const std::string& topic : topics) {
    if (std::none_of(connections_.begin(), connections_.end(), [&](const auto& c) { return c.topic == topic; }))
      throw Error(name_, "has no topic " + topic);
  }
  selected_.clear();
  std::copy_if(messages_.begin(), messages_.end(), std::back_inserter(selected_),
               [&](const Entry& entry) { return wanted(connections_[entry.connection]); });
  next_ = 0;
}

std::optional<Message> Rosbag2Reader::next() {
  while (next_ < selected_.size()) {
    if (std::optional<Message> message = read(selected_[next_++])) return message;
  }
  return std::nullopt;
}

std::optional<Message> Rosbag2Reader::read(const Entry& entry) {
  const Database& database = *databases_[entry.database];
  sqlite3_stmt* const row = database.by_row.get();
  sqlite3_reset(row);
  sqlite3_bind_int64(row, 1, entry.row);
  if (sqlite3_step(row) != SQLITE_ROW) {
    if (problem_.empty())
      problem_ = database.name + ": message " + std::to_string(entry.row) + ": " + database.reason();
    return std::nullopt;
  }
  const auto* const bytes = static_cast<const std::byte*>(sqlite3_column_blob(row, 0));
  const auto size = std::size_t(sqlite3_column_bytes(row, 0));
  const std::span<const std::byte> blob(bytes, bytes == nullptr ? 0 : size);
  std::optional<std::vector<std::byte>> plain = unpack(is_zstd(blob) ? "zstd" : "", blob);
  if (plain) return Message{entry.connection, entry.stamp, std::move(*plain)};
  if (problem_.empty()) problem_ = database.name + ": message " + std::to_string(entry.row) + " is damaged";
  return std::nullopt;
}

bool is_rosbag2(const std::filesystem::path& path) {
  if (!std::filesystem::is_directory(path)) return kind_of_file(path) == ".db3";
  if (std::filesystem::exists(path / "metadata.yaml")) return true;
  const std::filesystem::directory_iterator files(path), end;
  return std::any_of(files, end, [](const auto& entry) {
    const std::string kind = kind_of_file(entry.path());
    return !is_hidden(entry.path()) && (kind == ".db3" || kind == ".mcap");
  });
}

}  // namespace tilth
