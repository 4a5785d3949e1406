#include <algorithm>

#include <tilth/io/rosbag1_record.hpp>

namespace tilth::rosbag1 {
namespace {

constexpr std::uint32_t kUsualHeader = 256;       // [bytes] read at once
constexpr std::uint32_t kMaxHeader = 1 << 20;     // [bytes]
constexpr std::uint64_t kSecond = 1'000'000'000;  // [ns]

}  // namespace

std::string_view Record::text(std::string_view name) const {
  const auto it = fields.find(name);
  return it == fields.end() ? std::string_view() : std::string_view(it->second);
}

std::optional<Fields> parse_fields(std::string_view bytes) {
  Fields fields;
  while (!bytes.empty()) {
    const std::optional<std::uint32_t> size = number<std::uint32_t>(bytes);
    if (!size || *size > bytes.size() - sizeof(*size)) return std::nullopt;
    const std::string_view field = bytes.substr(sizeof(*size), *size);
    const std::size_t equals = field.find('=');
    if (equals == std::string_view::npos || equals == 0) return std::nullopt;
    fields.emplace(field.substr(0, equals), field.substr(equals + 1));
    bytes.remove_prefix(sizeof(*size) + *size);
  }
  return fields;
}

std::optional<Record> record_at(const InputFile& file, std::uint64_t position) {
  std::vector<std::byte> bytes = file.read(position, kUsualHeader);
  const std::optional<std::uint32_t> size = number<std::uint32_t>(as_text(bytes));
  if (!size || *size > kMaxHeader) return std::nullopt;
  const std::size_t needed = *size + 2 * sizeof(std::uint32_t);
  if (bytes.size() < needed) bytes = file.read(position, needed);
  if (bytes.size() < needed) return std::nullopt;
  const std::string_view text = as_text(bytes);
  std::optional<Fields> fields = parse_fields(text.substr(sizeof(*size), *size));
  if (!fields || !fields->contains("op")) return std::nullopt;
  return Record{std::move(*fields), position, position + needed,
                *number<std::uint32_t>(text.substr(sizeof(*size) + *size))};
}

std::optional<Connection> connection_of(const Record& record, std::string_view data) {
  const std::optional<std::uint32_t> id = record.field<std::uint32_t>("conn");
  const std::optional<Fields> fields = parse_fields(data);
  if (!id || !fields) return std::nullopt;
  const Record described{*fields};
  const std::string_view topic = record.text("topic").empty() ? described.text("topic") : record.text("topic");
  if (topic.empty() || described.text("type").empty()) return std::nullopt;
  return Connection{*id, std::string(topic), std::string(described.text("type")), std::string(described.text("md5sum")),
                    std::string(described.text("message_definition"))};
}

std::optional<std::uint64_t> nanoseconds(std::string_view time) {
  if (time.size() < 8) return std::nullopt;
  return *number<std::uint32_t>(time) * kSecond + *number<std::uint32_t>(time.substr(4));
}

std::string raw_time(std::uint64_t nanoseconds) {
  return raw(std::uint32_t(nanoseconds / kSecond)) + raw(std::uint32_t(nanoseconds % kSecond));
}

std::string fields_text(const Fields& fields) {
  std::string text;
  for (const auto& [name, value] : fields) {
    text += raw(std::uint32_t(name.size() + 1 + value.size())) + name + "=" + value;
  }
  return text;
}

std::string record_text(const Fields& header, std::string_view data) {
  const std::string fields = fields_text(header);
  return (raw(std::uint32_t(fields.size())) + fields + raw(std::uint32_t(data.size()))).append(data);
}

}  // namespace tilth::rosbag1
