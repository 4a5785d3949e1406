#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>

#include <tilth/core/error.hpp>
#include <tilth/core/point_records.hpp>

namespace tilth {
namespace {

template <class T>
void read_column(const PointRecords& records, const PointField& field, std::vector<double>& values) {
  for (std::size_t i = 0; i < records.count; ++i) {
    std::array<std::byte, sizeof(T)> raw;
    std::memcpy(raw.data(), records.bytes.data() + i * records.stride + field.offset, sizeof(T));
    if (records.byte_order != std::endian::native) std::reverse(raw.begin(), raw.end());
    values[i] = double(std::bit_cast<T>(raw));
  }
}

}  // namespace

std::size_t size_of(FieldType type) {
  static constexpr std::array<std::size_t, 10> sizes{1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return sizes[std::size_t(type)];
}

const PointField* PointRecords::find(std::string_view name) const {
  const auto it = std::find_if(fields.begin(), fields.end(), [&](const PointField& f) { return f.name == name; });
  return it == fields.end() ? nullptr : &*it;
}

std::vector<double> column(const PointRecords& records, const PointField& field) {
  assert(field.offset + size_of(field.type) <= records.stride);
  assert(records.bytes.size() >= records.count * records.stride);
  std::vector<double> values(records.count);
  switch (field.type) {
    case FieldType::i8: read_column<std::int8_t>(records, field, values); break;
    case FieldType::u8: read_column<std::uint8_t>(records, field, values); break;
    case FieldType::i16: read_column<std::int16_t>(records, field, values); break;
    case FieldType::u16: read_column<std::uint16_t>(records, field, values); break;
    case FieldType::i32: read_column<std::int32_t>(records, field, values); break;
    case FieldType::u32: read_column<std::uint32_t>(records, field, values); break;
    case FieldType::i64: read_column<std::int64_t>(records, field, values); break;
    case FieldType::u64: read_column<std::uint64_t>(records, field, values); break;
    case FieldType::f32: read_column<float>(records, field, values); break;
    case FieldType::f64: read_column<double>(records, field, values); break;
  }
  return values;
}

std::vector<Eigen::Vector3d> positions_of(const PointRecords& records, const std::string& where) {
  std::vector<Eigen::Vector3d> positions(records.count);
  for (int axis = 0; axis < 3; ++axis) {
    const std::string name(1, "xyz"[axis]);
    const PointField* field = records.find(name);
    if (field == nullptr) throw Error(where, "has no field " + name);
    const std::vector<double> values = column(records, *field);
    for (std::size_t i = 0; i < records.count; ++i) positions[i][axis] = values[i];
  }
  return positions;
}

}  // namespace tilth
