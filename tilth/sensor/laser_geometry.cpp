#include <cmath>

#include <tilth/sensor/laser_geometry.hpp>

namespace tilth {
namespace {

/// [m] the range of a laser whose correction is known at two distances, `at` [m] along one axis (manual, appendix F).
double between(const LaserOffsets& laser, double measured, double near, double near_at, double at) {
  constexpr double kFarAt = 25.04;  // [m]
  return measured + near + (laser.range - near) * (at - near_at) / (kFarAt - near_at);
}

}  // namespace

LaserGeometry::LaserGeometry(const PacketFormat& format)
    : offsets_(format.offsets), centre_radius_(format.centre_radius), centre_angle_(format.centre_angle) {
  for (const double elevation : format.elevations) {
    cosines_.push_back(std::cos(elevation));
    sines_.push_back(std::sin(elevation));
  }
}

/// All lasers leave from one optical centre, which may stand beside the axis.
Eigen::Vector3d LaserGeometry::central_point(std::size_t channel, double azimuth, double range) const {
  const double across = range * cosines_[channel], behind = azimuth - centre_angle_;
  const double x = across * std::cos(azimuth) + centre_radius_ * std::cos(behind);
  const double y = -across * std::sin(azimuth) - centre_radius_ * std::sin(behind);
  return {x, y, range * sines_[channel]};
}

/// Every laser has its own place as well (manual of the HDL-64E S3, appendix F).
Eigen::Vector3d LaserGeometry::offset_point(std::size_t channel, double head, double measured) const {
  const LaserOffsets& laser = offsets_[channel];
  const double azimuth = head + laser.azimuth, behind = head - centre_angle_;
  const double sine = std::sin(azimuth), cosine = std::cos(azimuth);
  const double up = sines_[channel], level = cosines_[channel];
  double range_x = measured + laser.range, range_y = range_x;
  if (laser.two_points) {
    const double across = range_x * level - laser.vertical * up;
    range_x = between(laser, measured, laser.range_x, 2.4, std::abs(across * sine - laser.horizontal * cosine));
    range_y = between(laser, measured, laser.range_y, 1.93, std::abs(across * cosine + laser.horizontal * sine));
  }
  const double across_x = range_x * level - laser.vertical * up, across_y = range_y * level - laser.vertical * up;
  return {across_y * cosine + laser.horizontal * sine + centre_radius_ * std::cos(behind),
          laser.horizontal * cosine - across_x * sine - centre_radius_ * std::sin(behind),
          range_y * up + laser.vertical * level};
}

}  // namespace tilth
