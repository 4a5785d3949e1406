#include <algorithm>
#include <cstring>

#include <tilth/core/error.hpp>
#include <tilth/io/cloud_records.hpp>

namespace tilth {
namespace {

static_assert(std::endian::native == std::endian::little, "records are written in the machine's order");

PointField& add_field(PointRecords& records, const std::string& name, FieldType type) {
  records.fields.push_back({name, type, records.stride});
  records.stride += size_of(type);
  return records.fields.back();
}

template <class T>
void fill(PointRecords& records, std::size_t offset, const std::vector<T>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::memcpy(records.bytes.data() + i * records.stride + offset, &values[i], sizeof(T));
  }
}

void check(const PointRecords& records) {
  for (const PointField& field : records.fields) {
    if (field.offset + size_of(field.type) > records.stride) {
      throw Error("field " + field.name, "reaches beyond its record of " + std::to_string(records.stride) + " bytes");
    }
  }
  if (records.bytes.size() < records.count * records.stride)
    throw Error("point records", "hold fewer bytes than points");
}

}  // namespace

PointRecords to_records(const PointCloud& cloud) {
  PointRecords records;
  records.count = cloud.size();
  for (const char* name : {"x", "y", "z"}) add_field(records, name, FieldType::f32);
  const bool has_intensities = !cloud.empty() && cloud.intensities.size() == cloud.size();
  const std::size_t intensity = has_intensities ? add_field(records, "intensity", FieldType::f32).offset : 0;
  const std::size_t ring = cloud.has_rings() ? add_field(records, "ring", FieldType::u16).offset : 0;
  const std::size_t time = cloud.has_times() ? add_field(records, "time", FieldType::f32).offset : 0;
  records.bytes.resize(records.count * records.stride);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3f p = cloud.points[i].cast<float>();
    std::memcpy(records.bytes.data() + i * records.stride, p.data(), 3 * sizeof(float));
  }
  if (has_intensities) fill(records, intensity, cloud.intensities);
  if (cloud.has_rings()) fill(records, ring, cloud.rings);
  if (cloud.has_times()) fill(records, time, cloud.times);
  return records;
}

PointRecords packed(const PointRecords& records) {
  check(records);
  PointRecords result;
  result.count = records.count;
  for (const PointField& field : records.fields) add_field(result, field.name, field.type);
  result.bytes.resize(result.count * result.stride);
  for (std::size_t f = 0; f < records.fields.size(); ++f) {
    const std::size_t size = size_of(records.fields[f].type);
    for (std::size_t i = 0; i < records.count; ++i) {
      const std::byte* from = records.bytes.data() + i * records.stride + records.fields[f].offset;
      std::byte* to = result.bytes.data() + i * result.stride + result.fields[f].offset;
      std::memcpy(to, from, size);
      if (records.byte_order != std::endian::little) std::reverse(to, to + size);
    }
  }
  return result;
}

}  // namespace tilth
