#include <algorithm>
#include <cmath>
#include <string>

#include <tilth/core/beam_model.hpp>
#include <tilth/core/error.hpp>

namespace tilth {
namespace {

double at(const std::vector<double>& list, std::size_t ring) {
  return list.empty() ? 0.0 : list[ring];
}

/// The vector, turned about z by -azimuth and down by `elevation` in the vertical plane it lies in.
Eigen::Vector3d turned_back(const Eigen::Vector3d& p, double elevation, double azimuth) {
  const double level = std::hypot(p.x(), p.y());
  if (level == 0) return p;
  const double ca = std::cos(azimuth), sa = std::sin(azimuth), ce = std::cos(elevation), se = std::sin(elevation);
  const double stretch = (level * ce + p.z() * se) / level;
  return {stretch * (p.x() * ca + p.y() * sa), stretch * (p.y() * ca - p.x() * sa), p.z() * ce - level * se};
}

void check_rings(const PointCloud& cloud, const BeamModel& beams) {
  if (!cloud.has_rings()) throw Error("beams", "cannot be corrected in a cloud without rings");
  for (const auto* list : {&beams.range, &beams.elevation, &beams.azimuth}) {
    if (list->empty() || cloud.empty()) continue;
    const std::size_t highest = *std::max_element(cloud.rings.begin(), cloud.rings.end());
    if (highest >= list->size()) {
      throw Error("beams", "are given for " + std::to_string(list->size()) + " rings, the scan has a ring " +
                               std::to_string(highest) + " (they count from 0)");
    }
  }
}

}  // namespace

std::size_t BeamModel::beams() const {
  return std::max({range.size(), elevation.size(), azimuth.size()});
}

bool BeamModel::ideal() const {
  const auto none = [](const std::vector<double>& list) {
    return std::all_of(list.begin(), list.end(), [](double e) { return e == 0; });
  };
  return none(range) && none(elevation) && none(azimuth) && encoder.isZero(0) && range_scale == 0 && walk == 0;
}

double dimness(double intensity, double bright) {
  return 1 - std::clamp(intensity / bright, 0.0, 1.0);
}

Eigen::Vector4d encoder_harmonics(const Eigen::Vector3d& point) {
  const double level = std::hypot(point.x(), point.y());
  if (level == 0) return Eigen::Vector4d::Zero();
  const double c = point.x() / level, s = point.y() / level;
  return {c, s, c * c - s * s, 2 * s * c};
}

Eigen::Vector3d true_direction(const BeamModel& beams, std::size_t ring, const Eigen::Vector3d& measured) {
  const double azimuth = at(beams.azimuth, ring) + encoder_harmonics(measured).dot(beams.encoder);
  return turned_back(measured, at(beams.elevation, ring), azimuth);
}

double reported_range(const BeamModel& beams, std::size_t ring, double range, double intensity) {
  return (1 + beams.range_scale) * range + at(beams.range, ring) + beams.walk * dimness(intensity, beams.bright);
}

double true_range(const BeamModel& beams, std::size_t ring, double reported, double dim) {
  return (reported - at(beams.range, ring) - beams.walk * dim) / (1 + beams.range_scale);
}

PointCloud corrected(const PointCloud& cloud, const BeamModel& beams) {
  if (beams.ideal()) return cloud;
  check_rings(cloud, beams);
  const bool dims = beams.walk != 0 && cloud.intensities.size() == cloud.size();
  PointCloud result = cloud;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d& measured = cloud.points[i];
    const double range = measured.norm();
    if (!(range > 0)) continue;
    const std::size_t ring = cloud.rings[i];
    const double dim = dims ? dimness(cloud.intensities[i], beams.bright) : 0.0;
    result.points[i] = (true_range(beams, ring, range, dim) / range) * true_direction(beams, ring, measured);
  }
  return result;
}

Scan corrected(const Scan& scan, const BeamModel& beams) {
  if (!scan.T_cloud_sensor) return {scan.stamp, corrected(scan.cloud, beams)};
  const PointCloud in_sensor = transform(scan.cloud, scan.T_cloud_sensor->inverse());
  return {scan.stamp, transform(corrected(in_sensor, beams), *scan.T_cloud_sensor), scan.T_cloud_sensor};
}

}  // namespace tilth
