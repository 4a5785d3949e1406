// The payload of one UDP datagram of a LiDAR, and where its numbers stand.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include <tilth/sensor/packet_format.hpp>

namespace tilth {

struct Packet {
  std::span<const std::byte> payload;
  std::optional<double> arrival;  ///< [s] since 1970, at the receiver; nothing where nobody wrote it down
};

enum class PacketKind : std::uint8_t {
  data,      ///< firings: 1206 or 1212 bytes
  device,    ///< Leishen's DIFOP: 1206 bytes
  position,  ///< Velodyne's position packet: 512 bytes
  other,
};
PacketKind kind_of(std::span<const std::byte> payload);

/// Where sensors send packets of that kind as they come from their makers; of kind other, as data.
std::uint16_t factory_port(PacketKind kind);

constexpr std::size_t kBlocks = 12, kSlots = 32;
constexpr std::uint8_t kDualReturn = 0x39;

/// A data packet taken apart. It only looks at the payload, which must outlive it.
class DataPacket {
 public:
  explicit DataPacket(std::span<const std::byte> payload);  ///< of kind data

  std::size_t size() const { return payload_.size(); }  ///< [bytes]; 1212 bytes that hold 1206 and zeros are 1206
  std::uint8_t model() const { return byte(size() - 1); }
  std::uint8_t return_mode() const { return byte(size() - 2); }
  bool dual() const { return return_mode() == kDualReturn; }

  bool valid(std::size_t block) const;             ///< it begins with FF EE and its azimuth is below a turn
  std::uint16_t azimuth(std::size_t block) const;  ///< [0.01 deg]
  std::uint16_t distance(std::size_t block, std::size_t slot) const;  ///< [units], 0: no return
  std::uint8_t intensity(std::size_t block, std::size_t slot) const;

  std::uint32_t microseconds() const;              ///< of 1206 bytes
  std::array<std::uint8_t, 6> whole_time() const;  ///< of 1212 bytes: date or seconds
  std::uint32_t fraction() const;                  ///< of 1212 bytes: [us] or [ns]

 private:
  std::uint8_t byte(std::size_t at) const { return std::to_integer<std::uint8_t>(payload_[at]); }
  std::uint32_t u32(std::size_t at) const;

  std::span<const std::byte> payload_;
};

}  // namespace tilth
