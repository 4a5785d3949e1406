// A packet of an Ouster sensor taken apart: columns of one measurement of all beams each, little-endian (Ouster's
// firmware user manual, "lidar data packet format"; ouster-sdk).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include <tilth/sensor/ouster_metadata.hpp>

namespace tilth {

/// [bytes] where the parts of such a packet stand.
struct OusterLayout {
  std::size_t header, column_header, pixel, column_footer, footer;
  std::size_t column_size(std::size_t rows) const { return column_header + rows * pixel + column_footer; }
  std::size_t size(std::size_t rows, std::size_t columns) const {
    return header + columns * column_size(rows) + footer;
  }
};
const OusterLayout& layout_of(OusterProfile profile);

/// By its length and first bytes.
bool is_ouster_packet(std::span<const std::byte> payload);

struct OusterPixel {
  double range = 0.0;      ///< [m] as measured, 0: no return
  float intensity = 0.0F;  ///< calibrated reflectivity, 0 to 255
};

class OusterPacket {
 public:
  /// `payload` has the size that `metadata` asks for; both must outlive this.
  OusterPacket(std::span<const std::byte> payload, const OusterMetadata& metadata);

  std::size_t columns() const { return metadata_->columns_a_packet; }
  bool valid(std::size_t column) const;               ///< measured, and of a measurement of the turn
  std::uint64_t timestamp(std::size_t column) const;  ///< [ns]
  std::size_t measurement(std::size_t column) const;  ///< of the turn, 0 at angle 0
  std::uint16_t frame(std::size_t column) const;      ///< number of the turn
  OusterPixel pixel(std::size_t column, std::size_t row, std::size_t echo) const;
  std::uint64_t serial() const;  ///< of the sensor; 0: not told
  std::uint32_t start() const;   ///< number of its start; 0: not told

 private:
  std::size_t begin_of(std::size_t column) const { return layout_->header + column * column_size_; }
  std::uint64_t number(std::size_t at, std::size_t bytes) const;

  std::span<const std::byte> payload_;
  const OusterMetadata* metadata_;
  const OusterLayout* layout_;
  std::size_t column_size_;
};

/// Packets of another sensor may be as long by chance. Throws Error naming `file`, where `metadata` are from, if both
/// tell a serial number and it is not the same.
void require_same_sensor(const OusterPacket& packet, const OusterMetadata& metadata, const std::string& file);

/// [bytes] of the packets of that sensor.
std::size_t packet_size(const OusterMetadata& metadata);

}  // namespace tilth
