#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include <tilth/core/error.hpp>
#include <tilth/io/input_file.hpp>
#include <tilth/io/las_reader.hpp>

namespace tilth {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers of LAS are read as they lie in memory");

constexpr std::size_t kOldHeader = 227, kHeader = 375;  // [bytes] up to version 1.2, and of 1.4
/// [bytes] of a point, by its format; its writer may append others.
constexpr std::array<std::size_t, 11> kPointSizes{20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};

template <class T>
T number_at(std::span<const std::byte> bytes, std::size_t position) {
  T value;
  std::memcpy(&value, bytes.data() + position, sizeof value);
  return value;
}

struct LasHeader {
  unsigned format = 0;
  std::size_t first = 0;   ///< [bytes] where the points begin
  std::size_t stride = 0;  ///< [bytes] of one
  std::uint64_t count = 0;
  std::array<double, 3> scale{}, offset{};  ///< [m]
};

void require(bool holds, const std::string& name, const std::string& what) {
  if (!holds) throw Error(name, what);
}

/// As table 3 of the specification has it.
LasHeader header_of(std::span<const std::byte> bytes, const std::string& name) {
  require(bytes.size() >= 4 && as_text(bytes.first(4)) == "LASF", name, "is no LAS file: it does not begin with LASF");
  require(bytes.size() >= kOldHeader, name, "is truncated within its header");
  const auto major = number_at<std::uint8_t>(bytes, 24), minor = number_at<std::uint8_t>(bytes, 25);
  require(major == 1 && minor <= 4, name,
          "is LAS " + std::to_string(major) + "." + std::to_string(minor) + ", expected 1.0 to 1.4");
  const bool wide = minor == 4;
  require(!wide || bytes.size() >= kHeader, name, "is truncated within its header");
  const auto format = number_at<std::uint8_t>(bytes, 104);
  require((format & 0xC0) == 0, name, "is compressed (LAZ): unpack it, as `laszip -i IN.laz -o OUT.las` does");
  require(format < kPointSizes.size(), name, "has points of format " + std::to_string(format) + ", expected 0 to 10");
  LasHeader header{.format = format, .first = number_at<std::uint32_t>(bytes, 96)};
  header.stride = number_at<std::uint16_t>(bytes, 105);
  header.count = number_at<std::uint32_t>(bytes, 107);
  if (wide && header.count == 0) header.count = number_at<std::uint64_t>(bytes, 247);
  require(header.stride >= kPointSizes[format], name,
          "has points of " + std::to_string(header.stride) + " bytes, expected at least " +
              std::to_string(kPointSizes[format]) + " of format " + std::to_string(format));
  require(header.first >= kOldHeader, name, "has points that begin within its header");
  for (std::size_t axis = 0; axis < 3; ++axis) {
    header.scale[axis] = number_at<double>(bytes, 131 + 8 * axis);
    header.offset[axis] = number_at<double>(bytes, 155 + 8 * axis);
    require(std::isfinite(header.scale[axis]) && header.scale[axis] > 0, name, "has a scale that is not above 0");
    require(std::isfinite(header.offset[axis]), name, "has an offset that is not finite");
  }
  const std::size_t there = header.first > bytes.size() ? 0 : (bytes.size() - header.first) / header.stride;
  require(there >= header.count, name,
          "has " + std::to_string(there) + " of " + std::to_string(header.count) + " points (truncated)");
  return header;
}

/// Whether a point is meant to be used (tables 8, 9, 16 and 17).
bool is_meant(std::span<const std::byte> point, unsigned format) {
  constexpr unsigned kLowNoise = 7, kHighNoise = 18;
  const auto byte_at = [&](std::size_t i) { return std::to_integer<unsigned>(point[i]); };
  const bool old = format < 6;
  const bool withheld = old ? (byte_at(15) & 0x80) != 0 : (byte_at(15) & 0x04) != 0;
  const unsigned kind = old ? byte_at(15) & 0x1F : byte_at(16);
  return !withheld && kind != kLowNoise && kind != kHighNoise;
}

void append(const void* value, std::size_t size, std::vector<std::byte>& bytes) {
  const auto* first = static_cast<const std::byte*>(value);
  bytes.insert(bytes.end(), first, first + size);
}

}  // namespace

PointRecords parse_las(std::span<const std::byte> bytes, const std::string& name) {
  constexpr std::size_t kIntensity = 12;
  const LasHeader header = header_of(bytes, name);
  PointRecords records;
  records.fields = {
      {"x", FieldType::f64, 0}, {"y", FieldType::f64, 8}, {"z", FieldType::f64, 16}, {"intensity", FieldType::u16, 24}};
  records.stride = 26;
  for (std::uint64_t i = 0; i < header.count; ++i) {
    const std::span<const std::byte> point = bytes.subspan(header.first + i * header.stride, header.stride);
    if (!is_meant(point, header.format)) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double value = number_at<std::int32_t>(point, 4 * axis) * header.scale[axis] + header.offset[axis];
      append(&value, sizeof value, records.bytes);
    }
    append(point.data() + kIntensity, sizeof(std::uint16_t), records.bytes);
    ++records.count;
  }
  return records;
}

PointRecords read_las(const std::filesystem::path& path) {
  return parse_las(read_file(path), path.string());
}

}  // namespace tilth
