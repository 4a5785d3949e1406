#include <array>
#include <cstring>
#include <utility>

#include <tilth/core/error.hpp>
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
  if (bytes.size() % kStride != 0) {
    throw Error(name,
                "has " + std::to_string(bytes.size()) +
                    " bytes, which is no multiple of the 16 bytes of a point (truncated, or not x y z intensity)");
  }
  PointRecords records;
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    records.fields.push_back({kNames[i], FieldType::f32, i * sizeof(float)});
  }
  records.stride = kStride;
  records.count = bytes.size() / kStride;
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
