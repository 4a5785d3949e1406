#include <algorithm>
#include <cassert>

#include <tilth/sensor/packet.hpp>

namespace tilth {
namespace {

constexpr std::size_t kShort = 1206, kLong = 1212, kPosition = 512, kBlockSize = 100, kHeader = 4, kSlotSize = 3;
constexpr std::uint16_t kTurn = 36000;  // [0.01 deg]
constexpr std::array<std::uint8_t, 8> kDeviceMagic{0xA5, 0xFF, 0x00, 0x5A, 0x11, 0x11, 0x55, 0x55};

std::uint8_t at(std::span<const std::byte> bytes, std::size_t i) {
  return std::to_integer<std::uint8_t>(bytes[i]);
}

bool has_flag(std::span<const std::byte> payload, std::size_t block) {
  return at(payload, block * kBlockSize) == 0xFF && at(payload, block * kBlockSize + 1) == 0xEE;
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

}  // namespace

PacketKind kind_of(std::span<const std::byte> payload) {
  if (payload.size() == kPosition) return PacketKind::position;
  if (payload.size() != kShort && payload.size() != kLong) return PacketKind::other;
  if (is_device(payload)) return PacketKind::device;
  for (std::size_t block = 0; block < kBlocks; ++block) {
    if (has_flag(payload, block)) return PacketKind::data;
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

DataPacket::DataPacket(std::span<const std::byte> payload) : payload_(without_padding(payload)) {
  assert(kind_of(payload) == PacketKind::data);
}

bool DataPacket::valid(std::size_t block) const {
  return has_flag(payload_, block) && azimuth(block) < kTurn;
}

std::uint16_t DataPacket::azimuth(std::size_t block) const {
  return std::uint16_t(byte(block * kBlockSize + 2) | byte(block * kBlockSize + 3) << 8);
}

std::uint16_t DataPacket::distance(std::size_t block, std::size_t slot) const {
  const std::size_t at = block * kBlockSize + kHeader + slot * kSlotSize;
  return std::uint16_t(byte(at) | byte(at + 1) << 8);
}

std::uint8_t DataPacket::intensity(std::size_t block, std::size_t slot) const {
  return byte(block * kBlockSize + kHeader + slot * kSlotSize + 2);
}

std::uint32_t DataPacket::microseconds() const {
  return u32(kBlocks * kBlockSize);
}

std::array<std::uint8_t, 6> DataPacket::whole_time() const {
  std::array<std::uint8_t, 6> bytes{};
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = byte(kBlocks * kBlockSize + i);
  return bytes;
}

std::uint32_t DataPacket::fraction() const {
  return u32(kBlocks * kBlockSize + 6);
}

std::uint32_t DataPacket::u32(std::size_t at) const {
  return std::uint32_t(byte(at)) | std::uint32_t(byte(at + 1)) << 8 | std::uint32_t(byte(at + 2)) << 16 |
         std::uint32_t(byte(at + 3)) << 24;
}

}  // namespace tilth
