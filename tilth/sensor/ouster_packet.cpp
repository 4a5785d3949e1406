#include <algorithm>
#include <array>
#include <cassert>
#include <string>

#include <tilth/core/error.hpp>
#include <tilth/sensor/ouster_packet.hpp>

namespace tilth {
namespace {

constexpr std::size_t kMeasurement = 8, kLegacyFrame = 10, kStatus = 10;  ///< in the header of a column
constexpr std::size_t kStart = 4, kSerial = 7;                            ///< in the header of a packet
constexpr std::uint64_t kPacketType = 1;

std::uint64_t little(std::span<const std::byte> bytes, std::size_t at, std::size_t count) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < count; ++i) value |= std::uint64_t(bytes[at + i]) << 8 * i;
  return value;
}

/// The first column is either measured or not, and of a turn of at most 4096.
bool begins_legacy(std::span<const std::byte> payload, std::size_t rows) {
  const OusterLayout& layout = layout_of(OusterProfile::legacy);
  const std::uint64_t status = little(payload, layout.column_size(rows) - layout.column_footer, layout.column_footer);
  return (status == 0 || status == 0xFFFFFFFF) && little(payload, kMeasurement, 2) < 4096;
}

}  // namespace

const OusterLayout& layout_of(OusterProfile profile) {
  static constexpr OusterLayout kLegacy{0, 16, 12, 4, 0}, kSingle{32, 12, 12, 0, 32};
  static constexpr OusterLayout kDual{32, 12, 16, 0, 32}, kLow{32, 12, 4, 0, 32};
  switch (profile) {
    case OusterProfile::legacy: return kLegacy;
    case OusterProfile::single: return kSingle;
    case OusterProfile::dual: return kDual;
    default: return kLow;
  }
}

bool is_ouster_packet(std::span<const std::byte> payload) {
  for (const std::size_t rows : {16U, 32U, 64U, 128U}) {
    for (const std::size_t columns : {4U, 8U, 16U}) {
      if (payload.size() == layout_of(OusterProfile::legacy).size(rows, columns) && begins_legacy(payload, rows))
        return true;
      for (const OusterProfile profile : {OusterProfile::single, OusterProfile::dual, OusterProfile::low}) {
        if (payload.size() == layout_of(profile).size(rows, columns) && little(payload, 0, 2) == kPacketType)
          return true;
      }
    }
  }
  return false;
}

std::size_t packet_size(const OusterMetadata& metadata) {
  return layout_of(metadata.profile).size(metadata.rows(), metadata.columns_a_packet);
}

OusterPacket::OusterPacket(std::span<const std::byte> payload, const OusterMetadata& metadata)
    : payload_(payload),
      metadata_(&metadata),
      layout_(&layout_of(metadata.profile)),
      column_size_(layout_->column_size(metadata.rows())) {
  assert(payload.size() == packet_size(metadata));
}

bool OusterPacket::valid(std::size_t column) const {
  if (measurement(column) >= metadata_->columns) return false;
  if (metadata_->profile != OusterProfile::legacy) return (number(begin_of(column) + kStatus, 2) & 1) != 0;
  return number(begin_of(column) + column_size_ - layout_->column_footer, 4) == 0xFFFFFFFF;
}

std::uint64_t OusterPacket::timestamp(std::size_t column) const {
  return number(begin_of(column), 8);
}

std::size_t OusterPacket::measurement(std::size_t column) const {
  return number(begin_of(column) + kMeasurement, 2);
}

std::uint16_t OusterPacket::frame(std::size_t column) const {
  return std::uint16_t(
      number(metadata_->profile == OusterProfile::legacy ? begin_of(column) + kLegacyFrame : std::size_t{2}, 2));
}

OusterPixel OusterPacket::pixel(std::size_t column, std::size_t row, std::size_t echo) const {
  const std::size_t at = begin_of(column) + layout_->column_header + row * layout_->pixel;
  const auto byte = [&](std::size_t offset) { return float(number(at + offset, 1)); };
  switch (metadata_->profile) {
    case OusterProfile::legacy: return {double(number(at, 4) & 0xFFFFF) * 1e-3, byte(4)};
    case OusterProfile::single: return {double(number(at, 4) & 0x7FFFF) * 1e-3, byte(4)};
    case OusterProfile::dual: return {double(number(at + 4 * echo, 4) & 0x7FFFF) * 1e-3, byte(4 * echo + 3)};
    default: return {double(number(at, 2) & 0x7FFF) * 8e-3, byte(2)};
  }
}

std::uint64_t OusterPacket::serial() const {
  return metadata_->profile == OusterProfile::legacy ? 0 : number(kSerial, 5);
}

std::uint32_t OusterPacket::start() const {
  return metadata_->profile == OusterProfile::legacy ? 0 : std::uint32_t(number(kStart, 3));
}

std::uint64_t OusterPacket::number(std::size_t at, std::size_t bytes) const {
  return little(payload_, at, bytes);
}

void require_same_sensor(const OusterPacket& packet, const OusterMetadata& metadata, const std::string& file) {
  const std::string serial = std::to_string(packet.serial());
  if (packet.serial() == 0 || metadata.serial.empty() || metadata.serial == serial) return;
  throw Error(file, "is of the sensor with serial number " + metadata.serial + ", but these packets are of " + serial);
}

}  // namespace tilth
