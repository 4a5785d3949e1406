// Where a distance that one laser measured lies, seen from the axis of the head: x forward (azimuth 0), y left, z up.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include <tilth/sensor/packet_format.hpp>

namespace tilth {

class LaserGeometry {
 public:
  explicit LaserGeometry(const PacketFormat& format);

  /// [m] of a shot of `channel` at `azimuth` [rad] of the head, clockwise, that measured `range` [m].
  Eigen::Vector3d point(std::size_t channel, double azimuth, double range) const {
    return offsets_.empty() ? central_point(channel, azimuth, range) : offset_point(channel, azimuth, range);
  }

 private:
  Eigen::Vector3d central_point(std::size_t channel, double azimuth, double range) const;
  Eigen::Vector3d offset_point(std::size_t channel, double azimuth, double range) const;

  std::vector<double> cosines_, sines_;  // of the channels' elevations
  std::vector<LaserOffsets> offsets_;    // of each channel; empty: none
  double centre_radius_, centre_angle_;  // [m] [rad]
};

}  // namespace tilth
