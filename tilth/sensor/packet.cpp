#include <algorithm>
#include <cassert>

#include <tilth/sensor/packet.hpp>

namespace tilth {
namespace {

constexpr std::size_t kShort = 1206, kLong = 1212, kHesai = 568, kPosition = 512;
constexpr std::uint8_t kHesaiYears = 100;  // from 1900, where Hesai counts from, to 2000
constexpr std::array<std::uint8_t, 8> kDeviceMagic{0xA5, 0xFF, 0x00, 0x5A, 0x11, 0x11, 0x55, 0x55};

std::uint8_t at(std::span<const std::byte> bytes, std::size_t i) {
  return std::to_integer<std::uint8_t>(bytes[i]);
}

bool has_flag(std::span<const std::byte> payload, std::size_t begin) {
  return at(payload, begin) == 0xFF && at(payload, begin + 1) == 0xEE;
}

/// A PandarXT-16's: start, protocol 6.1, 16 lasers, 8 blocks, units of 4 mm.
bool is_hesai(std::span<const std::byte> p) {
  const bool begins = at(p, 0) == 0xEE && at(p, 1) == 0xFF && at(p, 2) == 6 && at(p, 3) == 1;
  return begins && at(p, 6) == 16 && at(p, 7) == 8 && at(p, 9) == 4;
}

bool is_device(std::span<const std::byte> payload) {
  return std::equal(kDeviceMagic.begin(), kDeviceMagic.end(), payload.begin(),
                    [](std::uint8_t a, std::byte b) { return a == std::to_integer<std::uint8_t>(b); });
}

/// Drivers hand on 1206 bytes in a message with room for 1212.
std::span<const std::byte> without_padding(std::span<const std::byte> payload) {
  if (payload.size() != kLong) return payload;
  const bool padded = at(payload, kLong - 1) == 0 && at(payload, kLong - 2) == 0 && at(payload, kShort - 1) != 0;
  return padded ? payload.first(kShort) : payload;
}

const PacketLayout& layout_of_size(std::size_t size) {
  if (size == kHesai) return layout_of(PacketTail::hesai_568);
  return layout_of(size == kLong ? PacketTail::leishen_1212 : PacketTail::velodyne);
}

}  // namespace

PacketKind kind_of(std::span<const std::byte> payload) {
  if (payload.size() == kPosition) return PacketKind::position;
  if (payload.size() == kHesai) return is_hesai(payload) ? PacketKind::data : PacketKind::other;
  if (payload.size() != kShort && payload.size() != kLong) return PacketKind::other;
  if (is_device(payload)) return PacketKind::device;
  const PacketLayout& layout = layout_of(PacketTail::velodyne);
  for (std::size_t block = 0; block < layout.blocks; ++block) {
    if (has_flag(payload, block * layout.block_size())) return PacketKind::data;
  }
  return PacketKind::other;
}

std::uint16_t factory_port(PacketKind kind) {
  switch (kind) {
    case PacketKind::device: return 2369;
    case PacketKind::position: return 8308;
    default: return 2368;
  }
}

DataPacket::DataPacket(std::span<const std::byte> payload)
    : payload_(without_padding(payload)), layout_(layout_of_size(payload_.size())) {
  assert(kind_of(payload) == PacketKind::data);
}

bool DataPacket::dual() const {
  if (size() != kHesai) return return_mode() == 0x39;
  return return_mode() == 0x39 || return_mode() == 0x3B || return_mode() == 0x3C;
}

bool DataPacket::valid(std::size_t block) const {
  return (size() == kHesai || has_flag(payload_, begin_of(block))) && azimuth(block) < kAzimuthsATurn;
}

std::uint16_t DataPacket::azimuth(std::size_t block) const {
  const std::size_t at = begin_of(block) + layout_.block_header - 2;
  return std::uint16_t(byte(at) | byte(at + 1) << 8);
}

std::uint16_t DataPacket::distance(std::size_t block, std::size_t slot) const {
  const std::size_t at = begin_of(block) + layout_.block_header + slot * layout_.slot_size;
  return std::uint16_t(byte(at) | byte(at + 1) << 8);
}

std::uint8_t DataPacket::intensity(std::size_t block, std::size_t slot) const {
  return byte(begin_of(block) + layout_.block_header + slot * layout_.slot_size + 2);
}

std::uint32_t DataPacket::microseconds() const {
  return u32(layout_.time);
}

std::array<std::uint8_t, 6> DataPacket::whole_time() const {
  std::array<std::uint8_t, 6> bytes{};
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = byte(layout_.time + i);
  if (size() == kHesai) bytes[0] = std::uint8_t(std::max(bytes[0], kHesaiYears) - kHesaiYears);
  return bytes;
}

std::uint32_t DataPacket::fraction() const {
  return u32(layout_.time + 6);
}

std::uint32_t DataPacket::u32(std::size_t at) const {
  return std::uint32_t(byte(at)) | std::uint32_t(byte(at + 1)) << 8 | std::uint32_t(byte(at + 2)) << 16 |
         std::uint32_t(byte(at + 3)) << 24;
}

}  // namespace tilth
