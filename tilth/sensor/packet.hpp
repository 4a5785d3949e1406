// The payload of one UDP datagram of a LiDAR, and where its numbers stand.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include <tilth/sensor/hdl64_status.hpp>
#include <tilth/sensor/packet_format.hpp>

namespace tilth {

struct Packet {
  std::span<const std::byte> payload;
  std::optional<double> arrival;  ///< [s] since 1970, at the receiver; nothing where nobody wrote it down
};

enum class PacketKind : std::uint8_t {
  data,      ///< firings: 1206, 1212, (Hesai) 568, 1072, 1080, 1194, 1262 or (RoboSense) 1248 bytes
  device,    ///< DIFOP of a Leishen (1206 bytes) or RoboSense (1248)
  position,  ///< Velodyne's position packet: 512 bytes
  ouster,    ///< columns of an Ouster sensor
  other,
};
PacketKind kind_of(std::span<const std::byte> payload);

/// Where sensors send such packets as they come from their makers; of kind other, as Velodyne's data.
std::uint16_t factory_port(std::span<const std::byte> payload);

inline constexpr double kAzimuthsATurn = 36000.0;  ///< [0.01 deg] as packets count them

/// What one laser reports of one shot.
struct PacketEcho {
  std::uint16_t distance = 0;  ///< [units], 0: no return
  std::uint8_t intensity = 0;
};

/// A data packet taken apart: columns of shots at one azimuth, each with one echo or two. It only looks at the payload,
/// which must outlive it.
class DataPacket {
 public:
  explicit DataPacket(std::span<const std::byte> payload);  ///< of kind data

  std::size_t size() const { return payload_.size(); }  ///< [bytes]; 1212 bytes that hold 1206 and zeros are 1206
  const PacketLayout& layout() const { return *layout_; }
  std::size_t columns() const { return layout_->columns(dual_); }
  std::uint8_t model() const { return told(layout_->model); }       ///< 0 where such packets do not tell
  std::uint8_t return_mode() const { return told(layout_->mode); }  ///< 0 where such packets do not tell
  bool dual() const { return dual_; }                               ///< shots have two echoes

  /// Its azimuth is below a turn, and its first block begins with FF EE where such ones do.
  bool valid(std::size_t column) const { return valid_block(block_of(column, 0, 0)); }
  std::uint16_t azimuth(std::size_t column) const { return block_azimuth(block_of(column, 0, 0)); }  ///< [0.01 deg]
  PacketEcho echo(std::size_t column, std::size_t echo, std::size_t shot) const;  ///< none in a block not valid

  StatusByte status() const { return {byte(layout_->time + 4), byte(layout_->time + 5)}; }  ///< of an HDL-64E

  bool dated() const { return layout_->dated; }
  std::uint32_t microseconds() const;              ///< of those without a date: since the hour or the start
  std::array<std::uint8_t, 6> whole_time() const;  ///< of dated ones: the date from its year since 2000, or seconds
  std::uint32_t fraction() const;                  ///< of dated ones: [us] or [ns]

 private:
  std::size_t block_of(std::size_t column, std::size_t echo, std::size_t bank) const;
  bool valid_block(std::size_t block) const;
  std::uint16_t block_azimuth(std::size_t block) const;
  bool has_flag(std::size_t block) const;
  bool tells_two_echoes() const;
  std::size_t begin_of(std::size_t block) const { return layout_->header + block * layout_->block_size(); }
  std::uint8_t byte(std::size_t at) const { return std::to_integer<std::uint8_t>(payload_[at]); }
  std::uint8_t told(std::size_t at) const { return at == 0 ? std::uint8_t(0) : byte(at); }
  std::uint16_t u16(std::size_t at) const { return std::uint16_t(byte(at) | byte(at + 1) << 8); }
  std::uint16_t told_u16(std::size_t at) const;  // in the byte order of the packet
  std::uint32_t u32(std::size_t at) const { return std::uint32_t(u16(at)) | std::uint32_t(u16(at + 2)) << 16; }

  std::span<const std::byte> payload_;
  const PacketLayout* layout_;
  bool dual_ = false;
};

}  // namespace tilth
