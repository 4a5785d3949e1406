#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include <tilth/core/error.hpp>
#include <tilth/messages/point_cloud2.hpp>
#include <tilth/messages/ros_message_writer.hpp>

namespace tilth {
namespace {

/// FieldType by the datatype of the message, which counts from 1.
constexpr std::array kTypes{FieldType::i8,  FieldType::u8,  FieldType::i16, FieldType::u16,
                            FieldType::i32, FieldType::u32, FieldType::f32, FieldType::f64};
constexpr std::size_t kMostFields = 1000;

struct StatedField {
  PointField field;
  std::uint32_t count = 1;
};

StatedField read_field(RosMessageReader& reader) {
  PointField field;
  field.name = reader.text("fields.name");
  field.offset = reader.number<std::uint32_t>("fields.offset");
  const unsigned type = reader.number<std::uint8_t>("fields.datatype");
  const std::uint32_t count = reader.number<std::uint32_t>("fields.count");
  if (type < 1 || type > kTypes.size()) {
    throw Error("PointCloud2 field " + field.name, "datatype " + std::to_string(type) + " is none of 1 to 8");
  }
  field.type = kTypes[type - 1];
  return {field, count};
}

std::vector<StatedField> read_fields(RosMessageReader& reader) {
  const std::uint32_t count = reader.number<std::uint32_t>("fields");
  if (count > kMostFields) throw Error("PointCloud2 fields", std::to_string(count) + " of them are more than 1000");
  std::vector<StatedField> fields;
  for (std::uint32_t i = 0; i < count; ++i) fields.push_back(read_field(reader));
  return fields;
}

/// Those that have a value in records of `stride` bytes. A count of 0 is of no values, or what drivers leave where they
/// set none: a field then has its value if no other begins there and it ends within the record.
std::vector<PointField> with_values(const std::vector<StatedField>& stated, std::size_t stride) {
  std::vector<PointField> fields;
  for (const StatedField& s : stated) {
    const auto shares_place = [&](const StatedField& other) {
      return other.count > 0 && other.field.offset == s.field.offset;
    };
    const bool fits = s.field.offset + size_of(s.field.type) <= stride;
    if (s.count > 0 || (fits && std::none_of(stated.begin(), stated.end(), shares_place))) fields.push_back(s.field);
  }
  return fields;
}

void check_layout(const PointRecords& records, std::uint64_t width, std::uint64_t row_step) {
  for (const PointField& field : records.fields) {
    if (field.offset + size_of(field.type) > records.stride) {
      throw Error("PointCloud2 field " + field.name,
                  "offset " + std::to_string(field.offset) + " with " + std::to_string(size_of(field.type)) +
                      " bytes ends behind point_step " + std::to_string(records.stride));
    }
  }
  if (width * records.stride > row_step) {
    throw Error("PointCloud2 row_step", std::to_string(row_step) + " bytes hold no " + std::to_string(width) +
                                            " points of " + std::to_string(records.stride) + " bytes");
  }
}

/// The rows one after another, without the padding at their ends.
std::vector<std::byte> packed_rows(std::span<const std::byte> data, std::uint64_t height, std::uint64_t row_bytes,
                                   std::uint64_t row_step) {
  std::vector<std::byte> bytes;
  bytes.reserve(std::size_t(height * row_bytes));
  for (std::uint64_t row = 0; row < height; ++row) {
    const auto begin = data.begin() + std::ptrdiff_t(row * row_step);
    bytes.insert(bytes.end(), begin, begin + std::ptrdiff_t(row_bytes));
  }
  return bytes;
}

std::uint8_t datatype_of(const PointField& field) {
  for (std::size_t i = 0; i < kTypes.size(); ++i) {
    if (kTypes[i] == field.type) return std::uint8_t(i + 1);
  }
  throw Error("PointCloud2 field " + field.name, "64 bit integers have no datatype in the message");
}

}  // namespace

PointCloud2 parse_point_cloud2(std::span<const std::byte> message, Serialization serialization) {
  RosMessageReader reader(message, serialization, "PointCloud2");
  PointCloud2 cloud;
  RosMessageReader::Header header = reader.header();
  cloud.stamp = header.stamp;
  cloud.frame_id = std::move(header.frame_id);
  const std::uint64_t height = reader.number<std::uint32_t>("height");
  const std::uint64_t width = reader.number<std::uint32_t>("width");
  PointRecords& records = cloud.records;
  const std::vector<StatedField> fields = read_fields(reader);
  records.byte_order = reader.number<std::uint8_t>("is_bigendian") != 0 ? std::endian::big : std::endian::little;
  records.stride = reader.number<std::uint32_t>("point_step");
  records.fields = with_values(fields, records.stride);
  std::uint64_t row_step = reader.number<std::uint32_t>("row_step");
  if (row_step == 0) row_step = width * records.stride;  // left unset: rows without padding
  const std::span<const std::byte> data = reader.bytes(reader.number<std::uint32_t>("data"), "data");

  check_layout(records, width, height > 1 ? row_step : width * records.stride);
  if (height * width == 0) return cloud;
  if (records.stride == 0) throw Error("PointCloud2 point_step", "0 bytes hold no point");
  const std::uint64_t row_bytes = width * records.stride;
  const std::uint64_t needed = row_bytes > data.size() ? row_bytes : (height - 1) * row_step + row_bytes;
  if (needed > data.size()) {
    throw Error("PointCloud2 data", std::to_string(data.size()) + " bytes hold no " + std::to_string(height) + " x " +
                                        std::to_string(width) + " points, which need " + std::to_string(needed));
  }
  records.count = std::size_t(height * width);
  records.bytes = packed_rows(data, height, row_bytes, row_step);
  return cloud;
}

std::vector<std::byte> serialize_point_cloud2(const PointCloud2& cloud, Serialization serialization) {
  constexpr double kLimit = 4294967296.0;
  const PointRecords& records = cloud.records;
  const std::size_t size = records.count * records.stride;
  if (double(size) >= kLimit) throw Error("PointCloud2 data", std::to_string(size) + " bytes are more than 2^32");
  RosMessageWriter writer(serialization);
  writer.header(cloud.stamp, cloud.frame_id, "PointCloud2");
  writer.u32(1);
  writer.u32(records.count);
  writer.u32(records.fields.size());
  for (const PointField& field : records.fields) {
    writer.text(field.name);
    writer.u32(field.offset);
    writer.u8(datatype_of(field));
    writer.u32(1);
  }
  writer.u8(records.byte_order == std::endian::big ? 1 : 0);
  writer.u32(records.stride);
  writer.u32(size);
  writer.u32(size);
  writer.bytes(std::span(records.bytes).first(size));
  writer.u8(0);
  return writer.take();
}

}  // namespace tilth
