// Points as formats store them: records of named, typed fields. PCD, PLY, KITTI .bin and PointCloud2 all come down to
// this; what the fields mean (ring, time and its unit) is decided elsewhere.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace tilth {

enum class FieldType : std::uint8_t { i8, u8, i16, u16, i32, u32, i64, u64, f32, f64 };

std::size_t size_of(FieldType type);  ///< [bytes]

struct PointField {
  std::string name;
  FieldType type = FieldType::f32;
  std::size_t offset = 0;  ///< [bytes] in a record
};

struct PointRecords {
  std::vector<PointField> fields;
  std::size_t stride = 0;  ///< [bytes] of one record
  std::size_t count = 0;   ///< records; `bytes` holds count * stride
  std::endian byte_order = std::endian::little;
  std::vector<std::byte> bytes;

  const PointField* find(std::string_view name) const;  ///< nullptr where there is no such field
};

/// One field of every record as double (exact for all types up to 2^53). The field must lie within the stride.
std::vector<double> column(const PointRecords& records, const PointField& field);

/// x, y and z of every record. Throws Error naming `where` and the field that is missing.
std::vector<Eigen::Vector3d> positions_of(const PointRecords& records, const std::string& where);

}  // namespace tilth
