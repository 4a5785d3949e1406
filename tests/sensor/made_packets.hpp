// Packets put together byte by byte, as the makers' manuals describe them, without the tables of the library.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <string_view>
#include <vector>

#include <tilth/sensor/packet.hpp>

namespace tilth {

constexpr double kDeg = std::numbers::pi / 180.0;

struct Echo {
  std::uint16_t distance = 0;
  std::uint8_t intensity = 0;
};

class MadePacket {
 public:
  explicit MadePacket(std::size_t size) : bytes_(size) {}

  void byte(std::size_t at, unsigned value) { bytes_.at(at) = std::byte(value); }
  void little(std::size_t at, std::uint32_t value, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) byte(at + i, value >> 8 * i & 0xFF);
  }
  void big(std::size_t at, std::uint32_t value, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) byte(at + i, value >> 8 * (size - 1 - i) & 0xFF);
  }
  void text(std::size_t at, std::string_view value) {
    for (const char c : value) byte(at++, static_cast<unsigned char>(c));
  }
  void block(std::size_t block, unsigned azimuth, const std::function<Echo(std::size_t)>& echo_in_slot) {
    byte(block * 100, 0xFF), byte(block * 100 + 1, 0xEE);
    little(block * 100 + 2, azimuth % 36000, 2);
    for (std::size_t slot = 0; slot < 32; ++slot) {
      const Echo echo = echo_in_slot(slot);
      little(block * 100 + 4 + 3 * slot, echo.distance, 2);
      byte(block * 100 + 4 + 3 * slot + 2, echo.intensity);
    }
  }
  std::vector<std::byte>& bytes() { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
};

inline MadePacket device_packet() {
  MadePacket packet(1206);
  const std::array<unsigned, 8> magic{0xA5, 0xFF, 0x00, 0x5A, 0x11, 0x11, 0x55, 0x55};
  for (std::size_t i = 0; i < magic.size(); ++i) packet.byte(i, magic[i]);
  return packet;
}

/// A sensor that turns evenly and sends packets without end.
struct MadeSensor {
  std::size_t size = 1206;
  unsigned model = 0x22, mode = 0x37;
  double step = 39.8;          ///< [0.01 deg] from block to block (or pair to pair)
  double period = 110.592e-6;  ///< [s] of a block (or pair)
  double begin = 0.0;          ///< [0.01 deg]
  double clock = 100.0;        ///< [s] of the first packet
  std::function<Echo(std::size_t block, std::size_t slot)> echo = [](std::size_t, std::size_t) {
    return Echo{5000, 7};
  };

  bool dual() const { return mode == 0x39; }
  double packet_period() const { return (dual() ? 6 : 12) * period; }
  double azimuth(std::size_t packet, std::size_t block) const {
    return begin + step * double(packet * (dual() ? 6 : 12) + (dual() ? block / 2 : block));
  }

  /// Packet `k` with its clock in [us], as 1206 bytes carry it.
  MadePacket packet(std::size_t k) const {
    MadePacket made(size);
    for (std::size_t block = 0; block < 12; ++block) {
      made.block(block, unsigned(azimuth(k, block) + 0.5), [&](std::size_t slot) { return echo(block, slot); });
    }
    made.little(1200, std::uint32_t((clock + double(k) * packet_period()) * 1e6 + 0.5), 4);
    made.byte(size - 2, mode), made.byte(size - 1, model);
    return made;
  }

  std::vector<std::vector<std::byte>> packets(std::size_t count) const {
    std::vector<std::vector<std::byte>> all;
    for (std::size_t k = 0; k < count; ++k) all.push_back(packet(k).bytes());
    return all;
  }
};

inline std::vector<Packet> packets_of(const std::vector<std::vector<std::byte>>& payloads) {
  std::vector<Packet> packets;
  for (const auto& payload : payloads) packets.push_back({payload, std::nullopt});
  return packets;
}

}  // namespace tilth
