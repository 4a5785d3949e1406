#include <cassert>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string_view>
#include <vector>

#include <tilth/sensor/device_packet.hpp>
#include <tilth/sensor/packet.hpp>
#include <tilth/sensor/utc.hpp>

namespace tilth {
namespace {

constexpr std::size_t kLeishen = 1206;
constexpr double kHundredthDegree = std::numbers::pi / 18000.0;
constexpr std::size_t kSpeed = 8, kMicroseconds = 198, kPulse = 202, kSentence = 206, kSentenceSize = 128;

std::uint8_t byte(std::span<const std::byte> bytes, std::size_t at) {
  return std::to_integer<std::uint8_t>(bytes[at]);
}

std::uint16_t big_endian(std::span<const std::byte> bytes, std::size_t at) {
  return std::uint16_t(byte(bytes, at) << 8 | byte(bytes, at + 1));
}

int generation_of(std::span<const std::byte> p) {
  if (byte(p, 1196) == 3 || (byte(p, 1196) == 2 && byte(p, 1197) >> 4 == 8)) return 3;
  if ((byte(p, 1198) & 0x0F) == 4) return 4;
  if (byte(p, 1202) >= 0x64 && byte(p, 1203) >> 4 == 5) return 5;
  return byte(p, 1202) == 2 ? 2 : 0;
}

std::optional<double> date_at(std::span<const std::byte> p, std::size_t at) {
  return utc_seconds({2000 + byte(p, at), byte(p, at + 1), byte(p, at + 2), byte(p, at + 3), byte(p, at + 4),
                      double(byte(p, at + 5))});
}

std::vector<std::string_view> split(std::string_view text) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t comma = text.find(',');
    parts.push_back(text.substr(0, comma));
    if (comma == std::string_view::npos) return parts;
    text.remove_prefix(comma + 1);
  }
}

/// Two digits at `at`, or -1.
int pair_at(std::string_view text, std::size_t at) {
  int value = -1;
  if (at + 2 <= text.size()) std::from_chars(text.data() + at, text.data() + at + 2, value);
  return value;
}

/// $GPRMC,hhmmss.ss,A,latitude,N,longitude,E,speed,course,ddmmyy,... (NMEA 0183)
std::optional<double> utc_of_sentence(std::string_view text) {
  const std::vector<std::string_view> parts = split(text.substr(0, text.find('\0')));
  const bool fix = parts.size() > 9 && parts[0].size() == 6 && parts[0].ends_with("RMC") && parts[2] == "A";
  if (!fix || parts[1].size() < 6 || parts[9].size() != 6) return std::nullopt;
  double second = -1.0;
  std::from_chars(parts[1].data() + 4, parts[1].data() + parts[1].size(), second);
  return utc_seconds({2000 + pair_at(parts[9], 4), pair_at(parts[9], 2), pair_at(parts[9], 0), pair_at(parts[1], 0),
                      pair_at(parts[1], 2), second});
}

}  // namespace

DeviceInfo parse_device_packet(std::span<const std::byte> payload) {
  assert(kind_of(payload) == PacketKind::device);
  DeviceInfo info;
  info.revolutions_per_minute = big_endian(payload, kSpeed);
  if (payload.size() != kLeishen) return info;
  info.generation = generation_of(payload);
  if (info.generation != 2 && info.generation != 3) return info;
  const bool older = info.generation == 2;
  info.utc = date_at(payload, older ? 36 : 52);
  for (std::size_t i = 0; i < info.elevations.size(); ++i) {
    info.elevations[i] = std::int16_t(big_endian(payload, (older ? 234 : 245) + 2 * i)) * kHundredthDegree;
  }
  return info;
}

PositionInfo parse_position_packet(std::span<const std::byte> payload) {
  assert(kind_of(payload) == PacketKind::position);
  const std::uint32_t us =
      std::uint32_t(byte(payload, kMicroseconds)) | std::uint32_t(byte(payload, kMicroseconds + 1)) << 8 |
      std::uint32_t(byte(payload, kMicroseconds + 2)) << 16 | std::uint32_t(byte(payload, kMicroseconds + 3)) << 24;
  const auto sentence = payload.subspan(kSentence, kSentenceSize);
  const std::uint8_t pulse = byte(payload, kPulse);
  return {us * 1e-6, utc_of_sentence({reinterpret_cast<const char*>(sentence.data()), sentence.size()}),
          pulse <= std::uint8_t(PulseState::error) ? std::optional(PulseState(pulse)) : std::nullopt};
}

}  // namespace tilth
