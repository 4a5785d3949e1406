// What the data packets of a LiDAR mean: one row a sensor and generation, read by decoder and encoder alike
// (docs/formats/packets.md). Velodyne and Leishen share twelve blocks of FF EE, azimuth, 32 x (distance, intensity).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace tilth {

/// What follows the blocks.
enum class PacketTail : std::uint8_t {
  velodyne,      ///< [us] since the hour (4 bytes), return mode, model; the time is that of the first shot
  leishen_1206,  ///< as Velodyne's, but the time is that of the last shot
  leishen_1212,  ///< date or PTP seconds (6), fraction (4), return mode, model; the time is that of the last shot
  hesai_568,     ///< return mode, date, [us] and more; the time lies before the first shot of the last firing
};

/// [bytes] where the parts of such a packet stand.
struct PacketLayout {
  std::size_t size, header;             ///< of the payload; before the first block
  std::size_t blocks, slots;            ///< a packet; shots a block
  std::size_t block_header, slot_size;  ///< the first ends with the azimuth; the second begins with distance, intensity
  std::size_t mode, model, time;        ///< return mode and model byte; where there is a date, its six bytes
  std::size_t block_size() const { return block_header + slots * slot_size; }
};
const PacketLayout& layout_of(PacketTail tail);

struct PacketFormat {
  std::string name;   ///< as options take it; those of one sensor begin alike
  std::string title;  ///< as people call it
  PacketTail tail = PacketTail::velodyne;
  std::vector<std::uint8_t> models;  ///< model bytes; none: packets of this sensor do not tell
  double channel_period = 0.0;       ///< [s] from one channel to the next
  double firing_period = 0.0;        ///< [s] from one firing of all channels to the next
  double unit = 0.0;                 ///< [m] of a distance
  double centre_radius = 0.0;        ///< [m] of the optical centre from the axis
  double centre_angle = 0.0;         ///< [rad] by which the optical centre lies behind the beam
  std::vector<double> elevations;    ///< [rad] of each channel, in the order they fire
  std::vector<std::uint16_t> rings;  ///< of each channel, 0 the lowest

  std::size_t channels() const { return elevations.size(); }
  const PacketLayout& layout() const { return layout_of(tail); }

  /// [s] of the shot in `slot` of a block after the first shot of the block.
  double slot_time(std::size_t slot) const {
    return double(slot / channels()) * firing_period + double(slot % channels()) * channel_period;
  }
  double block_period() const { return double(layout().slots / channels()) * firing_period; }  ///< [s]
  double packet_period(bool dual) const {                                                      ///< [s]
    return double(layout().blocks / (dual ? 2 : 1)) * block_period();
  }
  double last_shot(bool dual) const {  ///< [s] after the first one of the packet
    return packet_period(dual) - block_period() + slot_time(layout().slots - 1);
  }
  double stamp_offset(bool dual) const;  ///< [s] from the first shot of a packet to the time that it tells
};

/// Every row. A sensor that its packets do not tell from another stands behind the likelier one.
std::span<const PacketFormat> packet_formats();

/// `format` with `elevations` [rad] in the order its channels fire, and their rings.
PacketFormat with_elevations(PacketFormat format, std::vector<double> elevations);

}  // namespace tilth
