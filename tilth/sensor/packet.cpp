#include <algorithm>
#include <cassert>
#include <initializer_list>

#include <tilth/sensor/ouster_packet.hpp>
#include <tilth/sensor/packet.hpp>

namespace tilth {
namespace {

constexpr std::size_t kShort = 1206, kLong = 1212, kPosition = 512, kSequence = 4;
constexpr std::uint8_t kHesaiYears = 100;  // from 1900, where Hesai counts from, to 2000

std::uint8_t at(std::span<const std::byte> bytes, std::size_t i) {
  return std::to_integer<std::uint8_t>(bytes[i]);
}

bool begins(std::span<const std::byte> payload, std::size_t begin, std::initializer_list<std::uint8_t> with) {
  return payload.size() >= begin + with.size() &&
         std::equal(with.begin(), with.end(), payload.begin() + std::ptrdiff_t(begin),
                    [](std::uint8_t a, std::byte b) { return a == std::to_integer<std::uint8_t>(b); });
}

bool has_bank_flag(std::span<const std::byte> payload, std::size_t begin, std::size_t bank) {
  constexpr std::array<std::uint8_t, 4> kBanks{0xEE, 0xDD, 0xCC, 0xBB};
  return at(payload, begin) == 0xFF && at(payload, begin + 1) == kBanks[bank];
}

bool has_either_flag(std::span<const std::byte> payload, std::size_t begin) {
  return begins(payload, begin, {0xEE, 0xFF}) || begins(payload, begin, {0xFF, 0xEE});
}

/// A Pandar40P's packets have no header: all of its blocks begin alike.
bool is_pandar40p(std::span<const std::byte> p) {
  const PacketLayout& layout = layout_of(PacketFamily::hesai_40p);
  for (std::size_t block = 0; block < layout.blocks; ++block) {
    if (!has_either_flag(p, block * layout.block_size())) return false;
  }
  return true;
}

/// By header: numbers of lasers and blocks, and units of 4 mm.
std::optional<PacketFamily> hesai_family(std::span<const std::byte> p) {
  constexpr std::size_t kHeader = 12;
  const bool headed = p.size() >= kHeader && begins(p, 0, {0xEE, 0xFF});
  const auto tells = [&](std::uint8_t lasers, std::uint8_t blocks) {
    return headed && at(p, 6) == lasers && at(p, 7) == blocks && at(p, 9) == 4;
  };
  const auto long_as = [&](PacketFamily family) {
    return p.size() == layout_of(family).size || p.size() == layout_of(family).size + kSequence;
  };
  const bool xt = headed && at(p, 2) == 6 && at(p, 3) == 1;
  if (p.size() == layout_of(PacketFamily::hesai_568).size && xt && tells(16, 8)) return PacketFamily::hesai_568;
  if (p.size() == layout_of(PacketFamily::hesai_xt32).size && xt && tells(32, 8)) return PacketFamily::hesai_xt32;
  if (p.size() == layout_of(PacketFamily::hesai_qt64).size && tells(64, 4)) return PacketFamily::hesai_qt64;
  if (long_as(PacketFamily::hesai_64) && headed && at(p, 2) == 64 && at(p, 3) == 6 && at(p, 5) == 4)
    return PacketFamily::hesai_64;
  if (long_as(PacketFamily::hesai_40p) && is_pandar40p(p)) return PacketFamily::hesai_40p;
  return std::nullopt;
}

std::optional<PacketFamily> robosense_family(std::span<const std::byte> p) {
  if (p.size() != layout_of(PacketFamily::robosense).size) return std::nullopt;
  if (begins(p, 0, {0x55, 0xAA, 0x05, 0x0A, 0x5A, 0xA5, 0x50, 0xA0})) return PacketFamily::robosense;
  if (begins(p, 0, {0x55, 0xAA, 0x05, 0x5A})) return PacketFamily::robosense_helios;
  return std::nullopt;
}

bool is_device(std::span<const std::byte> payload) {
  return begins(payload, 0, {0xA5, 0xFF, 0x00, 0x5A, 0x11, 0x11, 0x55, 0x55});
}

/// Drivers hand on 1206 bytes in a message with room for 1212; some of Hesai's packets may end with a number.
std::span<const std::byte> without_padding(std::span<const std::byte> payload) {
  if (const auto family = hesai_family(payload)) return payload.first(layout_of(*family).size);
  if (payload.size() != kLong) return payload;
  const bool padded = at(payload, kLong - 1) == 0 && at(payload, kLong - 2) == 0 && at(payload, kShort - 1) != 0;
  return padded ? payload.first(kShort) : payload;
}

/// Of 1206 bytes: blocks of further banks tell a VLS-128 and an HDL-64E.
const PacketLayout& short_layout(std::span<const std::byte> payload) {
  const PacketLayout& usual = layout_of(PacketFamily::velodyne);
  std::array<std::size_t, 4> blocks{};  // of each bank
  for (std::size_t block = 0; block < usual.blocks; ++block) {
    for (std::size_t bank = 0; bank < blocks.size(); ++bank)
      blocks[bank] += has_bank_flag(payload, block * usual.block_size(), bank) ? 1 : 0;
  }
  if (blocks[2] + blocks[3] > 1) return layout_of(PacketFamily::velodyne_128);
  return blocks[1] > 0 ? layout_of(PacketFamily::velodyne_64) : usual;
}

const PacketLayout& layout_of_payload(std::span<const std::byte> payload) {
  if (const auto family = hesai_family(payload)) return layout_of(*family);
  if (const auto family = robosense_family(payload)) return layout_of(*family);
  return payload.size() == kLong ? layout_of(PacketFamily::leishen_1212) : short_layout(payload);
}

}  // namespace

PacketKind kind_of(std::span<const std::byte> payload) {
  if (payload.size() == kPosition) return PacketKind::position;
  if (hesai_family(payload) || robosense_family(payload)) return PacketKind::data;
  if (payload.size() == layout_of(PacketFamily::robosense).size && is_device(payload)) return PacketKind::device;
  if (payload.size() != kShort && payload.size() != kLong)
    return is_ouster_packet(payload) ? PacketKind::ouster : PacketKind::other;
  if (is_device(payload)) return PacketKind::device;
  const PacketLayout& layout = layout_of(PacketFamily::velodyne);
  for (std::size_t block = 0; block < layout.blocks; ++block) {
    if (has_bank_flag(payload, block * layout.block_size(), 0)) return PacketKind::data;
  }
  return PacketKind::other;
}

std::uint16_t factory_port(std::span<const std::byte> payload) {
  const bool robosense = payload.size() == layout_of(PacketFamily::robosense).size;
  switch (kind_of(payload)) {
    case PacketKind::ouster: return 7502;
    case PacketKind::device:
      return factory_ports(robosense ? PacketFamily::robosense : PacketFamily::leishen_1206).device;
    case PacketKind::position: return 8308;
    default: return factory_ports(robosense ? PacketFamily::robosense : PacketFamily::velodyne).data;
  }
}

DataPacket::DataPacket(std::span<const std::byte> payload)
    : payload_(without_padding(payload)), layout_(&layout_of_payload(payload_)), dual_(tells_two_echoes()) {
  assert(kind_of(payload) == PacketKind::data);
}

/// An HDL-64E and a RoboSense do not tell their return mode: the blocks of a second echo stand at the azimuth of the
/// first.
bool DataPacket::tells_two_echoes() const {
  if (layout_->flag == BlockFlag::bank && layout_->mode == 0) {
    const std::size_t second = layout_->banks, third = 2 * second;
    const bool three = valid_block(0) && valid_block(second) && valid_block(third);
    return three && block_azimuth(0) == block_azimuth(second) && block_azimuth(third) != block_azimuth(0);
  }
  if (layout_->flag == BlockFlag::bank) return return_mode() == 0x39;
  return return_mode() == 0x39 || return_mode() == 0x3B || return_mode() == 0x3C;
}

std::size_t DataPacket::block_of(std::size_t column, std::size_t echo, std::size_t bank) const {
  const std::size_t echoes = dual_ ? 2 : 1, banks = layout_->banks;
  return column * banks * echoes + (layout_->echoes_by_bank ? bank * echoes + echo : echo * banks + bank);
}

bool DataPacket::has_flag(std::size_t block) const {
  const std::size_t bank = (layout_->echoes_by_bank && dual_ ? block / 2 : block) % layout_->banks;
  switch (layout_->flag) {
    case BlockFlag::none: return true;
    case BlockFlag::either: return has_either_flag(payload_, begin_of(block));
    default: return has_bank_flag(payload_, begin_of(block), bank);
  }
}

bool DataPacket::valid_block(std::size_t block) const {
  return has_flag(block) && block_azimuth(block) < kAzimuthsATurn;
}

std::uint16_t DataPacket::block_azimuth(std::size_t block) const {
  return told_u16(begin_of(block) + layout_->block_header - 2);
}

std::uint16_t DataPacket::told_u16(std::size_t at) const {
  return layout_->big_endian ? std::uint16_t(byte(at) << 8 | byte(at + 1)) : u16(at);
}

PacketEcho DataPacket::echo(std::size_t column, std::size_t echo, std::size_t shot) const {
  const std::size_t block = block_of(column, echo, shot / layout_->slots);
  if (!valid_block(block)) return {};
  const std::size_t at = begin_of(block) + layout_->block_header + shot % layout_->slots * layout_->slot_size;
  return {told_u16(at), byte(at + 2)};
}

std::uint32_t DataPacket::microseconds() const {
  return u32(layout_->time);
}

std::array<std::uint8_t, 6> DataPacket::whole_time() const {
  std::array<std::uint8_t, 6> bytes{};
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = byte(layout_->time + i);
  if (layout_->years == YearZero::of_1900) bytes[0] = std::uint8_t(std::max(bytes[0], kHesaiYears) - kHesaiYears);
  return bytes;
}

std::uint32_t DataPacket::fraction() const {
  const std::size_t at = layout_->fraction;
  const auto big = [&](std::size_t begin) { return std::uint32_t(byte(begin)) << 8 | byte(begin + 1); };
  switch (layout_->fraction_form) {
    case FractionForm::big: return big(at) << 16 | big(at + 2);
    case FractionForm::milli_and_micro: return big(at) * 1000 + big(at + 2);
    default: return u32(at);
  }
}

}  // namespace tilth
