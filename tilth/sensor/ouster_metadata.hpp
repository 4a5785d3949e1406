// What an Ouster sensor says of itself beside its packets: the metadata JSON that its tools store with a recording, or
// that it gives over HTTP. Without it packets mean nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

namespace tilth {

/// How a pixel is packed (Ouster's firmware user manual, "lidar data packet format").
enum class OusterProfile : std::uint8_t {
  legacy,  ///< LEGACY: one return, no header of the packet
  single,  ///< RNG19_RFL8_SIG16_NIR16: one return
  dual,    ///< RNG19_RFL8_SIG16_NIR16_DUAL: two returns
  low,     ///< RNG15_RFL8_NIR8: one return, in steps of 8 mm
};

struct OusterMetadata {
  std::string product, serial, firmware;  ///< as the sensor writes them; empty: not told
  std::uint32_t start = 0;                ///< number of the start after which it said so; 0: not told
  OusterProfile profile = OusterProfile::legacy;
  std::size_t columns = 1024;                       ///< measurements a turn
  std::size_t columns_a_packet = 16;                ///< [-]
  double rate = 10.0;                               ///< [Hz] turns
  std::size_t window_begin = 0, window_end = 1023;  ///< first and last measurement that is sent; may run through 0
  std::vector<double> altitudes, azimuths;          ///< [rad] of each row; azimuths are counted clockwise
  Eigen::Vector3d beam_origin{0, 0, 0};             ///< [m] of the beams, in the Lidar frame with the head at angle 0
  Eigen::Isometry3d T_sensor_lidar = Eigen::Isometry3d::Identity();

  std::size_t rows() const { return altitudes.size(); }
  bool in_window(std::size_t measurement) const;
  std::size_t window_size() const;                                         ///< measurements a turn that are sent
  double column_period() const { return 1.0 / (rate * double(columns)); }  ///< [s]
};

/// `text` is the JSON of firmware 1.12 to 3.x, flat or in sections; `name` that of its file. Throws Error naming the
/// key that is missing or makes no sense, or the profile that is not known.
OusterMetadata parse_ouster_metadata(std::string_view text, const std::string& name);

/// JSON that parse_ouster_metadata() reads, in the sections of firmware 3.
std::string ouster_metadata_text(const OusterMetadata& metadata);

std::string_view name_of(OusterProfile profile);  ///< as Ouster writes it

}  // namespace tilth
