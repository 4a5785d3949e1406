#include <algorithm>
#include <array>
#include <cstring>

#include <tilth/core/error.hpp>
#include <tilth/io/cloud_records.hpp>
#include <tilth/io/input_file.hpp>
#include <tilth/io/output_file.hpp>
#include <tilth/io/ply.hpp>
#include <tilth/io/ply_header.hpp>
#include <tilth/io/text_lines.hpp>

namespace tilth {
namespace {

[[noreturn]] void truncated(const std::string& name, const PlyElement& element, std::size_t got) {
  throw Error(name, "has " + std::to_string(got) + " of " + std::to_string(element.count) + " " +
                        (element.name == "vertex" ? "points" : "elements " + element.name) + " (truncated)");
}

PointRecords empty_records(const PlyElement& vertex, PlyFormat format, const std::string& name) {
  PointRecords records;
  for (const PlyProperty& property : vertex.properties) {
    if (property.list_size) continue;  // passed over: no point has a place for one
    records.fields.push_back({property.name, property.type, records.stride});
    records.stride += size_of(property.type);
  }
  if (records.stride == 0) throw Error(name, "has a vertex element without properties that are numbers");
  records.count = vertex.count;
  records.byte_order = format == PlyFormat::binary_big_endian ? std::endian::big : std::endian::little;
  return records;
}

class AsciiBody {
 public:
  AsciiBody(std::string_view text, std::size_t header_lines, const std::string& name)
      : lines_(text), header_lines_(header_lines), name_(name) {}

  void skip(const PlyElement& element) {
    for (std::size_t i = 0; i < element.count; ++i) next(element, i);
  }

  void read(const PlyElement& vertex, PointRecords& records) {
    for (std::size_t i = 0; i < vertex.count; ++i) {
      const std::vector<std::string_view> all = next(vertex, i);
      const std::string where = name_ + ", line " + std::to_string(header_lines_ + lines_.number());
      const auto values = scalar_words(all, vertex);
      const std::string stated = std::to_string(vertex.properties.size()), found = std::to_string(all.size());
      if (!values && vertex.has_lists())
        throw Error(where, "has " + found + " values, not those of its " + stated + " properties");
      if (!values) throw Error(where, "has " + found + " of " + stated + " values");
      records.bytes.resize((i + 1) * records.stride);
      for (std::size_t f = 0; f < values->size(); ++f) {
        const PointField& field = records.fields[f];
        std::byte* target = records.bytes.data() + i * records.stride + field.offset;
        if (store_number((*values)[f], field.type, target)) continue;
        throw Error(where, "property " + field.name + " is '" + std::string((*values)[f].substr(0, 40)) + "'");
      }
    }
  }

 private:
  std::vector<std::string_view> next(const PlyElement& element, std::size_t number) {
    while (const std::optional<std::string_view> line = lines_.next()) {
      std::vector<std::string_view> values = words(*line);
      if (!values.empty()) return values;
    }
    truncated(name_, element, number);
  }

  TextLines lines_;
  std::size_t header_lines_;
  const std::string& name_;
};

class BinaryBody {
 public:
  BinaryBody(std::span<const std::byte> data, PlyFormat format, const std::string& name)
      : data_(data), big_endian_(format == PlyFormat::binary_big_endian), name_(name) {}

  void skip(const PlyElement& element) {
    if (!element.has_lists()) {
      take(element, element.stride());
      return;
    }
    for (std::size_t i = 0; i < element.count; ++i) {
      for (const PlyProperty& property : element.properties) take(property, element, i);
    }
  }

  void read(const PlyElement& vertex, PointRecords& records) {
    if (!vertex.has_lists()) {
      const std::span<const std::byte> points = take(vertex, records.stride);
      records.bytes.assign(points.begin(), points.end());
      return;
    }
    for (std::size_t i = 0; i < vertex.count; ++i) {
      for (const PlyProperty& property : vertex.properties) {
        const std::span<const std::byte> value = take(property, vertex, i);
        if (!property.list_size) records.bytes.insert(records.bytes.end(), value.begin(), value.end());
      }
    }
  }

 private:
  std::span<const std::byte> take(const PlyElement& element, std::size_t stride) {
    const std::size_t whole = stride == 0 ? element.count : data_.size() / stride;
    if (whole < element.count) truncated(name_, element, whole);
    return advance(element.count * stride);
  }

  std::span<const std::byte> advance(std::size_t bytes) {
    const std::span<const std::byte> taken = data_.first(bytes);
    data_ = data_.subspan(bytes);
    return taken;
  }

  /// The value, or the values of a list.
  std::span<const std::byte> take(const PlyProperty& property, const PlyElement& element, std::size_t number) {
    const std::size_t size = size_of(property.list_size.value_or(property.type));
    if (size > data_.size()) truncated(name_, element, number);
    const std::span<const std::byte> first = advance(size);
    if (!property.list_size) return first;
    const PointRecords count{{{property.name, *property.list_size, 0}},
                             size,
                             1,
                             big_endian_ ? std::endian::big : std::endian::little,
                             {first.begin(), first.end()}};
    const double values = column(count, count.fields[0])[0];
    if (values < 0) throw Error(name_, "list " + property.name + " of " + element.name + " has a negative size");
    if (values > double(data_.size() / size_of(property.type))) truncated(name_, element, number);
    return advance(std::size_t(values) * size_of(property.type));
  }

  std::span<const std::byte> data_;
  bool big_endian_;
  const std::string& name_;
};

template <class Body>
void read_body(Body body, const PlyHeader& header, PointRecords& records) {
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex") return body.read(element, records);
    body.skip(element);
  }
}

std::string_view type_name(const PointField& field) {
  static constexpr std::array<std::string_view, 10> names{"char", "uchar", "short", "ushort", "int",
                                                          "uint", "",      "",      "float",  "double"};
  const std::string_view name = names[std::size_t(field.type)];
  if (name.empty()) throw Error("field " + field.name, "is a 64-bit integer, which PLY cannot hold");
  return name;
}

std::string header_text(const PointRecords& records) {
  std::string text = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(records.count) + "\n";
  for (const PointField& field : records.fields) {
    text.append("property ").append(type_name(field)).append(" ").append(field.name).append("\n");
  }
  return text + "end_header\n";
}

}  // namespace

PointRecords parse_ply(std::span<const std::byte> bytes, const std::string& name) {
  const PlyHeader header = parse_ply_header(as_text(bytes), name);
  const auto vertex = std::find_if(header.elements.begin(), header.elements.end(),
                                   [](const PlyElement& element) { return element.name == "vertex"; });
  if (vertex == header.elements.end()) throw Error(name, "has no element vertex");
  PointRecords records = empty_records(*vertex, header.format, name);
  const std::span<const std::byte> data = bytes.subspan(header.data_position);
  if (header.format == PlyFormat::ascii)
    read_body(AsciiBody(as_text(data), header.lines, name), header, records);
  else
    read_body(BinaryBody(data, header.format, name), header, records);
  return records;
}

PointRecords read_ply(const std::filesystem::path& path) {
  return parse_ply(read_file(path), path.string());
}

void write_ply(const std::filesystem::path& path, const PointRecords& records) {
  const PointRecords points = packed(records);
  const std::string header = header_text(points);
  OutputFile file(path);
  file.write(header);
  file.write(points.bytes);
  file.close();
}

}  // namespace tilth
