#include <array>
#include <cmath>
#include <initializer_list>

#include <tilth/sensor/packet_writer.hpp>
#include <tilth/sensor/utc.hpp>

namespace tilth {
namespace {

constexpr double kYear2000 = 946684800.0;  ///< [s]
constexpr std::uint64_t kSecond = 1'000'000, kHour = 3600 * kSecond;

void put(PacketBytes& bytes, std::size_t at, std::initializer_list<std::uint8_t> values) {
  for (const std::uint8_t value : values) bytes[at++] = std::byte(value);
}

/// [us] of the second of `stamp`, whose whole seconds go into `whole`.
std::uint64_t split(double stamp, double& whole) {
  whole = std::floor(stamp);
  const auto us = std::uint64_t(std::llround((stamp - whole) * 1e6));
  whole += double(us / kSecond);
  return us % kSecond;
}

void put_date(PacketBytes& payload, const PacketLayout& layout, double seconds) {
  const CivilTime date = civil_time(seconds);
  const int since = date.year - (layout.years == YearZero::of_1900 ? 1900 : 2000);
  put(payload, layout.time,
      {std::uint8_t(since), std::uint8_t(date.month), std::uint8_t(date.day), std::uint8_t(date.hour),
       std::uint8_t(date.minute), std::uint8_t(date.second)});
}

}  // namespace

void put_little(PacketBytes& bytes, std::size_t at, std::uint64_t value, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) bytes[at + i] = std::byte(value >> 8 * i & 0xFF);
}

void put_big(PacketBytes& bytes, std::size_t at, std::uint64_t value, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) bytes[at + i] = std::byte(value >> 8 * (size - 1 - i) & 0xFF);
}

void put_header(PacketBytes& payload, const PacketFormat& format) {
  const PacketLayout& layout = format.layout();
  const auto lasers = std::uint8_t(layout.slots), blocks = std::uint8_t(layout.blocks);
  switch (format.family) {
    case PacketFamily::hesai_568:
    case PacketFamily::hesai_xt32: put(payload, 0, {0xEE, 0xFF, 6, 1, 0, 0, lasers, blocks, 0, 4, 1, 0}); break;
    case PacketFamily::hesai_qt64: put(payload, 0, {0xEE, 0xFF, 3, 2, 0, 0, lasers, blocks, 0, 4, 1, 0}); break;
    case PacketFamily::hesai_64: put(payload, 0, {0xEE, 0xFF, lasers, blocks, 0, 4, 0, 0}); break;
    case PacketFamily::robosense: put(payload, 0, {0x55, 0xAA, 0x05, 0x0A, 0x5A, 0xA5, 0x50, 0xA0}); break;
    case PacketFamily::robosense_helios: put(payload, 0, {0x55, 0xAA, 0x05, 0x5A, 0, 1}); break;
    default: break;
  }
}

void put_block(PacketBytes& payload, const PacketLayout& layout, std::size_t block, double azimuth,
               std::span<const PacketEcho> shots) {
  constexpr std::array<std::uint8_t, 4> kBanks{0xEE, 0xDD, 0xCC, 0xBB};
  const auto number = layout.big_endian ? put_big : put_little;
  const std::size_t at = layout.header + block * layout.block_size();
  if (layout.flag == BlockFlag::bank) put(payload, at, {0xFF, kBanks[block % layout.banks]});
  if (layout.flag == BlockFlag::either) put(payload, at, {0xEE, 0xFF});
  number(payload, at + layout.block_header - 2, std::uint64_t(std::fmod(std::round(azimuth), kAzimuthsATurn)), 2);
  for (std::size_t slot = 0; slot < shots.size(); ++slot) {
    const std::size_t shot = at + layout.block_header + slot * layout.slot_size;
    number(payload, shot, shots[slot].distance, 2);
    payload[shot + 2] = std::byte(shots[slot].intensity);
  }
}

void put_tail(PacketBytes& payload, const PacketFormat& format, double stamp) {
  constexpr std::uint8_t kStrongest = 0x37;
  const PacketLayout& layout = format.layout();
  if (layout.mode != 0) payload[layout.mode] = std::byte(kStrongest);
  if (layout.model != 0) payload[layout.model] = std::byte(format.models.front());
  if (!layout.dated) {
    put_little(payload, layout.time, std::uint64_t(std::llround(std::fmod(stamp, 3600.0) * 1e6)) % kHour, 4);
    return;
  }
  double whole = 0.0;
  const std::uint64_t us = split(stamp, whole);
  if (format.family == PacketFamily::robosense_helios)
    put_big(payload, layout.time, std::uint64_t(whole), 6);
  else if (whole >= kYear2000)
    put_date(payload, layout, whole);
  switch (layout.fraction_form) {
    case FractionForm::little: put_little(payload, layout.fraction, us, 4); break;
    case FractionForm::big: put_big(payload, layout.fraction, us, 4); break;
    default: put_big(payload, layout.fraction, us / 1000, 2), put_big(payload, layout.fraction + 2, us % 1000, 2);
  }
}

}  // namespace tilth
