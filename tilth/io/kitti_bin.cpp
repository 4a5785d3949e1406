#include <array>
#include <cstring>
#include <utility>

#include <tilth/core/error.hpp>
#include <tilth/io/bin_columns.hpp>
#include <tilth/io/input_file.hpp>
#include <tilth/io/kitti_bin.hpp>
#include <tilth/io/output_file.hpp>

namespace tilth {
namespace {

constexpr std::array<const char*, 4> kNames{"x", "y", "z", "intensity"};
constexpr std::size_t kStride = kNames.size() * sizeof(float);

}  // namespace

PointRecords parse_kitti_bin(std::vector<std::byte> bytes, const std::string& name) {
  if (bytes.empty()) throw Error(name, "is empty (0 bytes)");
  const std::optional<std::vector<std::string>> columns = bin_columns(bytes);
  if (!columns) {
    const bool whole = bytes.size() % kStride == 0;
    throw Error(name,
                "has " + std::to_string(bytes.size()) + " bytes, " +
                    (whole ? "but they are not x y z intensity: " : "which is no multiple of the 16 of a point: ") +
                    "truncated, or of other columns than three to eight float32 that begin with x y z");
  }
  PointRecords records;
  for (const std::string& column : *columns) {
    records.fields.push_back({column, FieldType::f32, records.stride});
    records.stride += sizeof(float);
  }
  records.count = bytes.size() / records.stride;
  records.bytes = std::move(bytes);
  return records;
}

PointRecords read_kitti_bin(const std::filesystem::path& path) {
  return parse_kitti_bin(read_file(path), path.string());
}

void write_kitti_bin(const std::filesystem::path& path, const PointRecords& records) {
  std::vector<std::byte> bytes(records.count * kStride);
  for (std::size_t f = 0; f < kNames.size(); ++f) {
    const PointField* field = records.find(kNames[f]);
    if (!field && f < 3) throw Error(path.string(), std::string("needs the field ") + kNames[f] + " to write a scan");
    if (!field) continue;
    const std::vector<double> values = column(records, *field);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const float value = float(values[i]);
      std::memcpy(bytes.data() + i * kStride + f * sizeof(float), &value, sizeof(value));
    }
  }
  OutputFile file(path);
  file.write(bytes);
  file.close();
}

}  // namespace tilth
