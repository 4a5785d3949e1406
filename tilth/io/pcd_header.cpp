#include <algorithm>
#include <cctype>
#include <limits>
#include <map>
#include <optional>

#include <tilth/core/error.hpp>
#include <tilth/io/pcd_header.hpp>
#include <tilth/io/text_lines.hpp>

namespace tilth {
namespace {

constexpr std::size_t kMaxRecord = 1 << 20;  // [bytes]

using Words = std::vector<std::string_view>;
using Entries = std::map<std::string, Words, std::less<>>;

struct Header {
  const std::string& name;
  Entries entries;

  const Words& of(std::string_view key) const {
    const auto it = entries.find(key);
    if (it == entries.end() || it->second.empty())
      throw Error(name, "has no " + std::string(key) + " in its PCD header");
    return it->second;
  }

  std::size_t count(std::string_view key, std::string_view word) const {
    const std::optional<std::uint64_t> value = to_count(word);
    if (!value || *value > std::numeric_limits<std::size_t>::max() / kMaxRecord) {
      throw Error(name, std::string(key) + " is '" + std::string(word.substr(0, 40)) + "', expected a count");
    }
    return std::size_t(*value);
  }

  std::optional<std::size_t> count(std::string_view key) const {
    if (!entries.contains(key)) return std::nullopt;
    return count(key, of(key)[0]);
  }
};

std::string upper(std::string_view word) {
  std::string text(word);
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return char(std::toupper(c)); });
  return text;
}

std::optional<FieldType> type_of(std::string_view kind, std::size_t size) {
  static const std::map<std::pair<std::string, std::size_t>, FieldType> types{
      {{"I", 1}, FieldType::i8},  {{"U", 1}, FieldType::u8},  {{"I", 2}, FieldType::i16}, {{"U", 2}, FieldType::u16},
      {{"I", 4}, FieldType::i32}, {{"U", 4}, FieldType::u32}, {{"I", 8}, FieldType::i64}, {{"U", 8}, FieldType::u64},
      {{"F", 4}, FieldType::f32}, {{"F", 8}, FieldType::f64}};
  const auto it = types.find({upper(kind), size});
  return it == types.end() ? std::nullopt : std::optional(it->second);
}

std::vector<PcdColumn> columns_of(const Header& header) {
  const Words& names = header.of("FIELDS");
  const Words &sizes = header.of("SIZE"), &types = header.of("TYPE");
  const Words counts = header.entries.contains("COUNT") ? header.of("COUNT") : Words(names.size(), "1");
  if (sizes.size() != names.size() || types.size() != names.size() || counts.size() != names.size()) {
    throw Error(header.name, "has " + std::to_string(names.size()) + " FIELDS but " + std::to_string(sizes.size()) +
                                 " SIZE, " + std::to_string(types.size()) + " TYPE and " +
                                 std::to_string(counts.size()) + " COUNT");
  }
  std::vector<PcdColumn> columns;
  std::size_t record = 0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string field = "field " + std::string(names[i].substr(0, 40));
    const std::optional<FieldType> type = type_of(types[i], header.count("SIZE", sizes[i]));
    if (!type)
      throw Error(header.name, field + " has TYPE " + std::string(types[i]) + " with SIZE " + std::string(sizes[i]));
    const std::size_t elements = header.count("COUNT", counts[i]);
    if (elements > kMaxRecord) throw Error(header.name, field + " has COUNT " + std::string(counts[i]));
    columns.push_back({std::string(names[i]), *type, elements});
    record += columns.back().bytes();
    if (record > kMaxRecord)
      throw Error(header.name, "has points of more than " + std::to_string(kMaxRecord) + " bytes");
  }
  return columns;
}

std::size_t points_of(const Header& header) {
  const std::optional<std::size_t> points = header.count("POINTS"), width = header.count("WIDTH");
  if (!width) return points ? *points : header.count("POINTS", header.of("POINTS")[0]);
  const std::size_t height = header.count("HEIGHT").value_or(1);
  if (height != 0 && *width > std::numeric_limits<std::size_t>::max() / kMaxRecord / height) {
    throw Error(header.name, "has an absurd WIDTH times HEIGHT");
  }
  if (points && *width * height == 0) return *points;  // some writers leave them 0
  if (points && *points != *width * height) {
    throw Error(header.name, "states POINTS " + std::to_string(*points) + " but WIDTH " + std::to_string(*width) +
                                 " times HEIGHT " + std::to_string(height));
  }
  return *width * height;
}

PcdEncoding encoding_of(const Header& header) {
  const std::string_view text = header.of("DATA")[0];
  const std::string name = upper(text);
  if (name == "ASCII") return PcdEncoding::ascii;
  if (name == "BINARY") return PcdEncoding::binary;
  if (name == "BINARY_COMPRESSED") return PcdEncoding::binary_compressed;
  throw Error(header.name,
              "DATA is '" + std::string(text.substr(0, 40)) + "', expected ascii | binary | binary_compressed");
}

}  // namespace

PcdHeader parse_pcd_header(std::string_view text, const std::string& name) {
  if (text.empty()) throw Error(name, "is empty (0 bytes)");
  Header header{name, {}};
  TextLines lines(text);
  while (!header.entries.contains("DATA")) {
    const std::optional<std::string_view> line = lines.next();
    if (!line) throw Error(name, "is no PCD file, or is truncated: its header has no DATA");
    Words found = words(*line);
    if (found.empty() || found[0][0] == '#') continue;
    const std::string key = upper(found[0]);
    found.erase(found.begin());
    header.entries[key == "COLUMNS" ? "FIELDS" : key] = std::move(found);
  }
  PcdHeader result{columns_of(header), points_of(header), encoding_of(header), lines.position(), lines.number()};
  return result;
}

}  // namespace tilth
