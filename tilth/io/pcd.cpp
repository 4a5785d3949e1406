#include <algorithm>
#include <cstring>

#include <tilth/core/error.hpp>
#include <tilth/io/cloud_records.hpp>
#include <tilth/io/input_file.hpp>
#include <tilth/io/lzf.hpp>
#include <tilth/io/output_file.hpp>
#include <tilth/io/pcd.hpp>
#include <tilth/io/pcd_header.hpp>
#include <tilth/io/text_lines.hpp>

namespace tilth {
namespace {

PointRecords empty_records(const PcdHeader& header, const std::string& name) {
  PointRecords records;
  for (const PcdColumn& column : header.columns) {
    if (column.is_read()) records.fields.push_back({column.name, column.type, records.stride});
    records.stride += column.bytes();
  }
  if (records.stride == 0) throw Error(name, "has COUNT 0 of every field: points of no bytes");
  records.count = header.points;
  return records;
}

/// Whether `data` holds points of these columns, each with all its elements.
bool holds(std::span<const std::byte> data, const PcdHeader& header) {
  std::size_t stride = 0, named = 0, elements = 0;
  for (const PcdColumn& column : header.columns) {
    stride += column.bytes();
    named += column.is_padding() ? 0 : column.bytes();
    elements += column.elements;
  }
  if (header.encoding == PcdEncoding::binary) return data.size() / stride >= header.points;
  if (header.encoding == PcdEncoding::binary_compressed) {
    std::uint32_t sizes[2]{};
    if (data.size() < sizeof(sizes)) return false;
    std::memcpy(sizes, data.data(), sizeof(sizes));
    return sizes[1] == header.points * stride || sizes[1] == header.points * named;
  }
  TextLines lines(as_text(data));
  std::vector<std::string_view> first;
  for (auto line = lines.next(); line && first.empty(); line = lines.next()) first = words(*line);
  return first.size() == elements;
}

/// Columns of COUNT 0 taken for single values where the data has room for them.
PcdHeader with_counts(const PcdHeader& header, std::span<const std::byte> data) {
  PcdHeader single = header;
  for (PcdColumn& column : single.columns) column.elements = std::max<std::size_t>(column.elements, 1);
  return holds(data, single) ? single : header;
}

[[noreturn]] void truncated(const std::string& name, std::size_t got, std::size_t stated) {
  throw Error(name, "has " + std::to_string(got) + " of " + std::to_string(stated) + " points (truncated)");
}

void store_line(const std::vector<std::string_view>& values, const PcdHeader& header, std::byte* record,
                const std::string& where) {
  std::size_t value = 0;
  for (const PcdColumn& column : header.columns) {
    if (column.is_read() && !store_number(values[value], column.type, record)) {
      throw Error(where, "field " + column.name + " is '" + std::string(values[value].substr(0, 40)) + "'");
    }
    value += column.elements;
    record += column.bytes();
  }
}

void read_ascii(std::string_view text, const PcdHeader& header, const std::string& name, PointRecords& records) {
  TextLines lines(text);
  std::size_t columns = 0, points = 0;
  for (const PcdColumn& column : header.columns) columns += column.elements;
  while (const std::optional<std::string_view> line = lines.next()) {
    const std::vector<std::string_view> values = words(*line);
    if (values.empty()) continue;
    const std::string where = name + ", line " + std::to_string(header.lines + lines.number());
    if (points == header.points)
      throw Error(where, "is beyond the " + std::to_string(points) + " POINTS of the header");
    if (values.size() != columns) {
      throw Error(where, "has " + std::to_string(values.size()) + " of " + std::to_string(columns) + " values");
    }
    records.bytes.resize((points + 1) * records.stride);
    store_line(values, header, records.bytes.data() + points * records.stride, where);
    ++points;
  }
  if (points < header.points) truncated(name, points, header.points);
}

void read_binary(std::span<const std::byte> data, const std::string& name, PointRecords& records) {
  if (data.size() / records.stride < records.count) truncated(name, data.size() / records.stride, records.count);
  const std::span<const std::byte> points = data.first(records.count * records.stride);
  records.bytes.assign(points.begin(), points.end());
}

/// `data` holds one column after the other; PCL leaves the padding columns out, other writers keep them.
void interleave(std::span<const std::byte> data, const PcdHeader& header, bool padding_kept, PointRecords& records) {
  records.bytes.resize(records.count * records.stride);
  std::size_t offset = 0, from = 0;
  for (const PcdColumn& column : header.columns) {
    const std::size_t size = column.bytes();
    const std::size_t stored = column.is_padding() && !padding_kept ? 0 : size;
    for (std::size_t i = 0; stored > 0 && i < records.count; ++i, from += stored) {
      std::memcpy(records.bytes.data() + i * records.stride + offset, data.data() + from, stored);
    }
    offset += size;
  }
}

void read_compressed(std::span<const std::byte> data, const PcdHeader& header, const std::string& name,
                     PointRecords& records) {
  std::uint32_t sizes[2];
  if (data.size() < sizeof(sizes)) throw Error(name, "ends before its compressed data (truncated)");
  std::memcpy(sizes, data.data(), sizeof(sizes));
  data = data.subspan(sizeof(sizes));
  if (sizes[0] > data.size()) {
    throw Error(name, "has " + std::to_string(data.size()) + " of " + std::to_string(sizes[0]) +
                          " bytes of compressed data (truncated)");
  }
  std::size_t named = 0;
  for (const PcdColumn& column : header.columns) named += column.is_padding() ? 0 : column.bytes();
  const bool padding_kept = sizes[1] == records.count * records.stride;
  if (!padding_kept && sizes[1] != records.count * named) {
    throw Error(name, "states " + std::to_string(sizes[1]) + " bytes of points, but its " +
                          std::to_string(records.count) + " points take " +
                          std::to_string(records.count * records.stride));
  }
  const std::optional<std::vector<std::byte>> columns = lzf_decompress(data.first(sizes[0]), sizes[1]);
  if (!columns) throw Error(name, "has corrupt compressed data (LZF)");
  interleave(*columns, header, padding_kept, records);
}

char kind_of(FieldType type) {
  static constexpr char kinds[] = "IUIUIUIUFF";
  return kinds[std::size_t(type)];
}

std::string header_text(const PointRecords& records) {
  std::string fields = "FIELDS", sizes = "SIZE", types = "TYPE", counts = "COUNT";
  for (const PointField& field : records.fields) {
    fields.append(" ").append(field.name);
    sizes.append(" ").append(std::to_string(size_of(field.type)));
    types.append({' ', kind_of(field.type)});
    counts.append(" 1");
  }
  const std::string count = std::to_string(records.count);
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n" + fields + "\n" + sizes + "\n" + types + "\n" +
         counts + "\nWIDTH " + count + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + count + "\nDATA binary\n";
}

}  // namespace

PointRecords parse_pcd(std::span<const std::byte> bytes, const std::string& name) {
  const PcdHeader stated = parse_pcd_header(as_text(bytes), name);
  const std::span<const std::byte> data = bytes.subspan(stated.data_position);
  const PcdHeader header = with_counts(stated, data);
  PointRecords records = empty_records(header, name);
  if (header.encoding == PcdEncoding::ascii)
    read_ascii(as_text(data), header, name, records);
  else if (header.encoding == PcdEncoding::binary)
    read_binary(data, name, records);
  else
    read_compressed(data, header, name, records);
  return records;
}

PointRecords read_pcd(const std::filesystem::path& path) {
  return parse_pcd(read_file(path), path.string());
}

void write_pcd(const std::filesystem::path& path, const PointRecords& records) {
  const PointRecords points = packed(records);
  OutputFile file(path);
  file.write(header_text(points));
  file.write(points.bytes);
  file.close();
}

}  // namespace tilth
