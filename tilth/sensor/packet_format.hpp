// What the data packets of a LiDAR mean: one row a sensor and generation, read by decoder and encoder alike
// (docs/formats/packets.md). A packet holds blocks of an azimuth and one (distance, intensity) a shot.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace tilth {

/// Packets that look alike.
enum class PacketFamily : std::uint8_t {
  velodyne,          ///< 12 blocks; [us] since the hour, return mode, model; the time is that of the first shot
  velodyne_64,       ///< HDL-64E: as those, the lower lasers in blocks DD EE; a status byte instead of mode and model
  velodyne_128,      ///< VLS-128: as those, four blocks a firing; the time is that of the fourth group of lasers
  leishen_1206,      ///< as Velodyne's, but the time is that of the last shot
  leishen_1212,      ///< date or PTP seconds (6), fraction (4), return mode, model; the time is that of the last shot
  hesai_568,         ///< return mode, date, [us] and more; the time lies before the first shot of the last firing
  hesai_xt32,        ///< PandarXT-32: the same in 1080 bytes
  hesai_64,          ///< Pandar64: 6 blocks; [us], return mode, date; the time lies after the last firing
  hesai_40p,         ///< Pandar40P: 10 blocks that begin with EE FF; the same
  hesai_qt64,        ///< PandarQT: 4 blocks; [us], return mode, date; the time lies before the first firing
  robosense,         ///< RS-LiDAR: 12 blocks behind a date, big-endian; the time is that of the first shot
  robosense_helios,  ///< RS-Helios: the same behind seconds since 1970
};

enum class BlockFlag : std::uint8_t {
  none,
  bank,    ///< FF EE; FF DD, CC, BB of further banks
  either,  ///< EE FF or FF EE
};
enum class YearZero : std::uint8_t { of_2000, of_1900 };
enum class FractionForm : std::uint8_t { little, big, milli_and_micro };  ///< the last: two big-endian numbers

/// [bytes] where the parts of such a packet stand.
struct PacketLayout {
  std::size_t size, header;             ///< of the payload; before the first block
  std::size_t blocks, slots;            ///< a packet; shots a block
  std::size_t block_header, slot_size;  ///< the first ends with the azimuth; the second begins with distance, intensity
  std::size_t mode, model, time;        ///< return mode and model byte, 0: none; where there is a date, its six bytes
  std::size_t fraction = 0;             ///< of the second, where there is a date: four bytes
  std::size_t banks = 1;                ///< blocks that one after the other hold one firing
  BlockFlag flag = BlockFlag::bank;
  bool echoes_by_bank = false;  ///< of two returns a shot: both blocks of a bank stand together
  bool dated = false;           ///< tells a date or seconds since 1970
  YearZero years = YearZero::of_2000;
  FractionForm fraction_form = FractionForm::little;
  bool big_endian = false;  ///< azimuths and distances
  constexpr std::size_t block_size() const { return block_header + slots * slot_size; }
  constexpr std::size_t column_shots() const { return banks * slots; }
  constexpr std::size_t columns(bool dual) const { return blocks / (dual ? 2 * banks : banks); }  ///< azimuths a packet
};
const PacketLayout& layout_of(PacketFamily family);

/// UDP ports that such sensors send to as they come from their makers.
struct FactoryPorts {
  std::uint16_t data = 0, device = 0;  ///< 0: none is sent
};
FactoryPorts factory_ports(PacketFamily family);

/// How one laser is mounted beside its elevation, after Velodyne's manual of the HDL-64E (appendix F): a range is first
/// lengthened, then the optical centre shifted.
struct LaserOffsets {
  double azimuth = 0.0;                     ///< [rad] by which it points ahead of the head, clockwise
  double range = 0.0;                       ///< [m] added to every distance
  double range_x = 0.0, range_y = 0.0;      ///< [m] instead of that at 2.4 m aside and 1.93 m ahead
  bool two_points = false;                  ///< range_x and range_y count
  double horizontal = 0.0, vertical = 0.0;  ///< [m] of its optical centre, across the beam to the left and up
};

struct PacketFormat {
  std::string name;   ///< as options take it; those of one sensor begin alike
  std::string title;  ///< as people call it
  PacketFamily family = PacketFamily::velodyne;
  std::vector<std::uint8_t> models;   ///< model bytes; none: packets of this sensor do not tell
  double firing_period = 0.0;         ///< [s] from one firing of all channels to the next
  double unit = 0.0;                  ///< [m] of a distance
  double centre_radius = 0.0;         ///< [m] of the optical centre from the axis
  double centre_angle = 0.0;          ///< [rad] by which the optical centre lies behind the beam
  std::vector<double> elevations;     ///< [rad] of each channel, in the order of the packet
  std::vector<double> channel_times;  ///< [s] of each channel after the head stands at the azimuth told
  std::vector<LaserOffsets> offsets;  ///< of each channel; empty: none
  std::vector<std::uint16_t> rings;   ///< of each channel, 0 the lowest
  bool needs_calibration = false;     ///< means nothing without the angles and offsets of the unit itself

  std::size_t channels() const { return elevations.size(); }
  const PacketLayout& layout() const { return layout_of(family); }

  /// [s] of the shot `shot` of a column after the head stands at the azimuth of the column.
  double shot_time(std::size_t shot) const {
    return double(shot / channels()) * firing_period + channel_times[shot % channels()];
  }
  double column_period() const { return double(layout().column_shots() / channels()) * firing_period; }  ///< [s]
  double packet_period(bool dual) const { return double(layout().columns(dual)) * column_period(); }     ///< [s]
  double last_shot(bool dual) const {  ///< [s] after the azimuth of the first column of the packet
    return packet_period(dual) - column_period() + shot_time(layout().column_shots() - 1);
  }
  double stamp_offset(bool dual) const;  ///< [s] from the azimuth of the first column of a packet to the time it tells
};

/// Every row. A sensor that its packets do not tell from another stands behind the likelier one.
std::span<const PacketFormat> packet_formats();

/// `format` with `elevations` [rad] in the order of its channels, and their rings.
PacketFormat with_elevations(PacketFormat format, std::vector<double> elevations);

}  // namespace tilth
