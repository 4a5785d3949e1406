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
  data,      ///< firings: 1206, 1212 or (Hesai PandarXT-16) 568 bytes
  device,    ///< Leishen's DIFOP: 1206 bytes
  position,  ///< Velodyne's position packet: 512 bytes
  other,
};
PacketKind kind_of(std::span<const std::byte> payload);

/// Where sensors send packets of that kind as they come from their makers; of kind other, as data.
std::uint16_t factory_port(PacketKind kind);

inline constexpr double kAzimuthsATurn = 36000.0;  ///< [0.01 deg] as packets count them

constexpr std::size_t kMostSlots = 32;  ///< of a block, whatever the sensor

/// A data packet taken apart. It only looks at the payload, which must outlive it.
class DataPacket {
 public:
  explicit DataPacket(std::span<const std::byte> payload);  ///< of kind data

  std::size_t size() const { return payload_.size(); }  ///< [bytes]; 1212 bytes that hold 1206 and zeros are 1206
  std::size_t blocks() const { return layout_.blocks; }
  std::size_t slots() const { return layout_.slots; }
  std::uint8_t model() const { return byte(layout_.model); }
  std::uint8_t return_mode() const { return byte(layout_.mode); }
  bool dual() const;  ///< two blocks hold the echoes of the same shots

  bool valid(std::size_t block) const;  ///< its azimuth is below a turn, and it begins with FF EE where such ones do
  std::uint16_t azimuth(std::size_t block) const;                     ///< [0.01 deg]
  std::uint16_t distance(std::size_t block, std::size_t slot) const;  ///< [units], 0: no return
  std::uint8_t intensity(std::size_t block, std::size_t slot) const;

  bool dated() const { return size() != 1206; }
  std::uint32_t microseconds() const;              ///< of those without a date: since the hour or the start
  std::array<std::uint8_t, 6> whole_time() const;  ///< of dated ones: the date from its year since 2000, or seconds
  std::uint32_t fraction() const;                  ///< of dated ones: [us] or [ns]

 private:
  std::size_t begin_of(std::size_t block) const { return layout_.header + block * layout_.block_size(); }
  std::uint8_t byte(std::size_t at) const { return std::to_integer<std::uint8_t>(payload_[at]); }
  std::uint32_t u32(std::size_t at) const;

  std::span<const std::byte> payload_;
  PacketLayout layout_;
};

}  // namespace tilth
