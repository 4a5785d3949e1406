// What a spinning LiDAR is: where its beams point and when each one fires. Elevations and firing times after the
// makers' manuals and drivers (Velodyne VLP-16, HDL-32E, HDL-64E S2; Leishen C16 v3). Seen from above the head turns
// clockwise.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace tilth {

struct LidarModel {
  std::string name;
  std::vector<double> elevations;      ///< [rad] of each ring, ascending: ring 0 is the lowest beam
  std::vector<double> firing_offsets;  ///< [s] of each ring after the start of its firing
  std::vector<double> azimuths;        ///< [rad] by which each ring points ahead of the head; empty: none does
  std::size_t columns = 0;             ///< firings a turn
  double firing_period = 0.0;          ///< [s] from one firing to the next
  double period = 0.1;                 ///< [s] of one turn
  double min_range = 0.0;              ///< [m]
  double max_range = 0.0;              ///< [m]
  double range_step = 0.0;             ///< [m] the packets' unit of distance
  double centre_radius = 0.0;          ///< [m] of the optical centre from the axis
  double centre_angle = 0.0;           ///< [rad] by which the optical centre lies behind the beams
  double rosette_angle = 0.0;          ///< [rad] half the view of one that draws a rosette about +x; 0: it spins

  std::size_t rings() const { return elevations.size(); }

  /// [s] since the start of the turn at which `ring` fires in `column`.
  double time_of(std::size_t column, std::size_t ring) const {
    return double(column) * firing_period + firing_offsets[ring];
  }

  /// Unit vector of the beam of `ring`, `time` seconds after the head looked along +x (x forward, y left, z up). A
  /// rosette is drawn by two wedges that turn against each other, and takes seconds to repeat itself.
  Eigen::Vector3d direction(std::size_t ring, double time) const;

  /// [m] the optical centre at that time: ranges count from there.
  Eigen::Vector3d origin(double time) const;

  /// The ring whose elevation [rad] is nearest. O(log rings).
  std::size_t ring_of(double elevation) const;
};

LidarModel vlp16();             ///< 16 beams, 2 degrees apart, 55.296 us a firing
LidarModel hdl32();             ///< 32 beams, 4/3 degrees apart, 46.08 us a firing
LidarModel hdl64();             ///< 64 beams, 1/3 degree apart above -8.33 degrees, 1/2 below; 48 us a firing
LidarModel leishen_c16();       ///< 16 beams, 2 degrees apart, 50 us a firing
LidarModel vlp32c();            ///< 32 beams, 1/3 degree apart in the middle, 55.296 us a firing
LidarModel vls128();            ///< 128 beams, 0.11 degrees apart in the middle, 53.3 us a firing
LidarModel hdl64_s2();          ///< as hdl64(), but fires as the manual says and has packets: 48 us a firing
LidarModel hdl64_s3();          ///< the same, 57.6 us a firing
LidarModel hesai_xt32();        ///< 32 beams, 1 degree apart, 50 us a firing
LidarModel hesai_pandar64();    ///< 64 beams, 1/6 degree apart in the middle, 55.56 us a firing
LidarModel hesai_pandar40p();   ///< 40 beams, 1/3 degree apart in the middle, 55.56 us a firing
LidarModel hesai_qt64();        ///< 64 beams over 104 degrees, 166.7 us a firing
LidarModel robosense_rs16();    ///< 16 beams, 2 degrees apart, 55.5 us a firing
LidarModel robosense_helios();  ///< 32 beams over 70 degrees, 55.56 us a firing

LidarModel quanergy_m8();  ///< 8 beams, 3 degrees apart, 0.14 degrees a firing
LidarModel os1_64();       ///< 64 beams, 0.53 degrees apart, 1024 firings a turn, all beams at once
LidarModel ruby_128();     ///< 128 beams, 0.11 degrees apart in the middle, 0.2 degrees a firing
LidarModel rosette();      ///< 6 lines side by side, drawn as a rosette of 70 degrees; as Livox sensors do

std::span<const std::string_view> lidar_names();
LidarModel make_lidar(std::string_view name);  ///< throws Error listing the names

/// `lidar` with `columns` firings spread evenly over a turn.
LidarModel with_columns(LidarModel lidar, std::size_t columns);

}  // namespace tilth
