#include <algorithm>
#include <map>

#include <tilth/core/error.hpp>
#include <tilth/io/ply_header.hpp>
#include <tilth/io/text_lines.hpp>

namespace tilth {
namespace {

constexpr std::size_t kMaxProperties = 10000;

using Words = std::vector<std::string_view>;

[[noreturn]] void refuse(const std::string& where, std::string_view word, const std::string& expected) {
  throw Error(where, "has '" + std::string(word.substr(0, 40)) + "', expected " + expected);
}

FieldType type_of(std::string_view word, const std::string& where) {
  static const std::map<std::string_view, FieldType> types{
      {"char", FieldType::i8},   {"int8", FieldType::i8},     {"uchar", FieldType::u8},   {"uint8", FieldType::u8},
      {"short", FieldType::i16}, {"int16", FieldType::i16},   {"ushort", FieldType::u16}, {"uint16", FieldType::u16},
      {"int", FieldType::i32},   {"int32", FieldType::i32},   {"uint", FieldType::u32},   {"uint32", FieldType::u32},
      {"float", FieldType::f32}, {"float32", FieldType::f32}, {"double", FieldType::f64}, {"float64", FieldType::f64}};
  const auto it = types.find(word);
  if (it == types.end()) refuse(where, word, "a property type such as float or uchar");
  return it->second;
}

PlyFormat format_of(const Words& line, const std::string& where) {
  const std::string_view format = line.size() > 1 ? line[1] : "";
  if (format == "ascii") return PlyFormat::ascii;
  if (format == "binary_little_endian") return PlyFormat::binary_little_endian;
  if (format == "binary_big_endian") return PlyFormat::binary_big_endian;
  refuse(where, format, "format ascii | binary_little_endian | binary_big_endian");
}

PlyElement element_of(const Words& line, const std::string& where) {
  if (line.size() != 3) refuse(where, line[0], "element NAME COUNT");
  const std::optional<std::uint64_t> count = to_count(line[2]);
  if (!count) refuse(where, line[2], "a count");
  return {std::string(line[1]), std::size_t(*count), {}};
}

PlyProperty property_of(const Words& line, const std::string& where) {
  if (line.size() == 3) return {std::string(line[2]), type_of(line[1], where), std::nullopt};
  if (line.size() != 5 || line[1] != "list")
    refuse(where, line[0], "property TYPE NAME or property list TYPE TYPE NAME");
  const FieldType size = type_of(line[2], where);
  if (size == FieldType::f32 || size == FieldType::f64) refuse(where, line[2], "a whole-number type for a list's size");
  return {std::string(line[4]), type_of(line[3], where), size};
}

void take(const Words& line, const std::string& where, PlyHeader& header, bool& has_format) {
  const std::string_view key = line[0];
  if (key == "comment" || key == "obj_info") return;
  if (key == "format") {
    header.format = format_of(line, where);
    has_format = true;
  } else if (key == "element") {
    header.elements.push_back(element_of(line, where));
  } else if (key == "property") {
    if (header.elements.empty()) refuse(where, key, "an element before its first property");
    std::vector<PlyProperty>& properties = header.elements.back().properties;
    properties.push_back(property_of(line, where));
    if (properties.size() > kMaxProperties) refuse(where, key, "at most " + std::to_string(kMaxProperties));
  } else {
    refuse(where, key, "format, element, property, comment, obj_info or end_header");
  }
}

}  // namespace

bool PlyElement::has_lists() const {
  return std::any_of(properties.begin(), properties.end(),
                     [](const PlyProperty& p) { return p.list_size.has_value(); });
}

std::size_t PlyElement::stride() const {
  std::size_t bytes = 0;
  for (const PlyProperty& property : properties) bytes += property.list_size ? 0 : size_of(property.type);
  return bytes;
}

std::optional<Words> scalar_words(const Words& all, const PlyElement& element) {
  Words scalars;
  std::size_t at = 0;
  for (const PlyProperty& property : element.properties) {
    if (at >= all.size()) return std::nullopt;
    const std::string_view word = all[at++];
    if (!property.list_size) {
      scalars.push_back(word);
      continue;
    }
    const std::optional<std::uint64_t> size = to_count(word);
    if (!size || *size > all.size() - at) return std::nullopt;
    at += std::size_t(*size);
  }
  return at == all.size() ? std::optional(scalars) : std::nullopt;
}

PlyHeader parse_ply_header(std::string_view text, const std::string& name) {
  if (text.empty()) throw Error(name, "is empty (0 bytes)");
  TextLines lines(text);
  if (lines.next() != std::string_view("ply")) throw Error(name, "is no PLY file: it does not begin with 'ply'");
  PlyHeader header;
  bool has_format = false;
  while (const std::optional<std::string_view> line = lines.next()) {
    const Words found = words(*line);
    if (found.empty()) continue;
    if (found[0] != "end_header") {
      take(found, lines.where(name), header, has_format);
      continue;
    }
    if (!has_format) throw Error(name, "has no format in its PLY header");
    header.data_position = lines.position();
    header.lines = lines.number();
    return header;
  }
  throw Error(name, "has no end_header (truncated)");
}

}  // namespace tilth
