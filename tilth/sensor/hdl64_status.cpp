#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include <tilth/sensor/hdl64_status.hpp>

namespace tilth {
namespace {

constexpr std::size_t kLasers = 64, kTable = 1820, kRow = 7, kLaserSize = 28, kLaserUsed = 21, kFirstLaser = 7,
                      kDate = 1792, kDateSize = 6;
constexpr std::string_view kUnit = "UNIT#";
constexpr std::string_view kNamed = "HMSDNYGTV";  ///< types of packets whose value is no byte of the table
constexpr std::uint8_t kWarning = 'W';            ///< type of a byte of the table that only an S3 sends
constexpr double kAngleUnit = std::numbers::pi / 18000.0, kLengthUnit = 0.001;

using Table = std::array<std::uint8_t, kTable>;

/// The table from whole cycles of 260 times seven bytes, turned to where it begins; nothing where it does not.
std::optional<Table> table_of(std::span<const StatusByte> bytes, bool& s3) {
  Table table{};
  std::size_t count = 0;
  for (const StatusByte& byte : bytes) {
    if (kNamed.find(char(byte.type)) != std::string_view::npos) continue;
    s3 |= byte.type == kWarning;
    table[count++] = byte.value;
    if (count == kTable) break;
  }
  if (count < kTable) return std::nullopt;
  Table turned = table;
  for (std::size_t begin = 0; begin < kTable; ++begin) {
    const auto matches = [&](std::size_t i) { return table[(begin + i) % kTable] == std::uint8_t(kUnit[i]); };
    std::size_t same = 0;
    while (same < kUnit.size() && matches(same)) ++same;
    if (same < kUnit.size()) continue;
    std::rotate(turned.begin(), turned.begin() + std::ptrdiff_t(begin), turned.end());
    return turned;
  }
  return std::nullopt;
}

std::int16_t signed_at(const Table& table, std::size_t at) {
  return std::int16_t(std::uint16_t(table[at] | table[at + 1] << 8));
}

/// CRC-16 with the polynomial 0x8005 over the 20 bytes of every laser behind its number.
std::uint16_t checksum(const Table& table) {
  std::uint16_t sum = 0;
  for (std::size_t laser = 0; laser < kLasers; ++laser) {
    for (std::size_t i = 1; i < kLaserUsed; ++i) {
      sum = std::uint16_t(sum ^ table[kFirstLaser + laser * kLaserSize + i] << 8);
      for (int bit = 0; bit < 8; ++bit) sum = std::uint16_t(sum & 0x8000 ? sum << 1 ^ 0x8005 : sum << 1);
    }
  }
  return sum;
}

void put(Table& table, std::size_t at, double value) {
  const auto number = std::uint16_t(std::int16_t(std::lround(value)));
  table[at] = std::uint8_t(number & 0xFF), table[at + 1] = std::uint8_t(number >> 8);
}

}  // namespace

std::optional<UnitCalibration> hdl64_calibration(std::span<const StatusByte> bytes) {
  bool s3 = false;
  const std::optional<Table> table = table_of(bytes, s3);
  if (!table) return std::nullopt;
  const auto told = std::uint16_t(signed_at(*table, kTable - 2));
  if (told != (s3 ? checksum(*table) : kTable)) return std::nullopt;
  const auto unset = [](std::uint8_t byte) { return byte == 0xFF; };
  if (std::all_of(table->begin() + kDate, table->begin() + kDate + kDateSize, unset)) return std::nullopt;
  UnitCalibration unit{"its packets", std::vector<LaserCalibration>(kLasers)};
  for (std::size_t i = 0; i < kLasers; ++i) {
    const std::size_t at = kFirstLaser + i * kLaserSize;
    if ((*table)[at] != i) return std::nullopt;
    const auto number = [&](std::size_t field) { return double(signed_at(*table, at + 1 + 2 * field)); };
    LaserOffsets offsets;
    offsets.azimuth = -number(1) * kAngleUnit;
    offsets.range = number(2) * kLengthUnit;
    offsets.range_x = number(3) * kLengthUnit, offsets.range_y = number(4) * kLengthUnit;
    offsets.two_points = number(3) != 0.0 || number(4) != 0.0;
    offsets.vertical = number(5) * kLengthUnit, offsets.horizontal = number(6) * kLengthUnit;
    unit.lasers[i] = {number(0) * kAngleUnit, offsets};
  }
  return unit;
}

std::vector<StatusByte> hdl64_status_bytes(const UnitCalibration& unit, bool s3) {
  Table table{};
  std::copy(kUnit.begin(), kUnit.end(), table.begin());
  for (std::size_t i = 0; i < kLasers; ++i) {
    const auto& [elevation, o] = unit.lasers[i];
    const std::size_t at = kFirstLaser + i * kLaserSize;
    const std::array<double, 7> values{elevation / kAngleUnit,    -o.azimuth / kAngleUnit, o.range / kLengthUnit,
                                       o.range_x / kLengthUnit,   o.range_y / kLengthUnit, o.vertical / kLengthUnit,
                                       o.horizontal / kLengthUnit};
    table[at] = std::uint8_t(i);
    for (std::size_t field = 0; field < values.size(); ++field) put(table, at + 1 + 2 * field, values[field]);
  }
  table[kDate + 1] = table[kDate + 2] = 1;  // calibrated on the first day of 2000
  put(table, kTable - 2, s3 ? double(std::int16_t(checksum(table))) : double(kTable));
  std::vector<StatusByte> bytes;
  for (std::size_t i = 0; i < kTable; ++i) {
    if (i % kRow == 0) {
      for (const char type : kNamed) bytes.push_back({std::uint8_t(type), 1});
    }
    const bool warning = s3 && i > kFirstLaser && (i - kFirstLaser) % kLaserSize == kLaserSize - 1;
    bytes.push_back({warning ? kWarning : std::uint8_t('1' + i % kRow), table[i]});
  }
  return bytes;
}

}  // namespace tilth
