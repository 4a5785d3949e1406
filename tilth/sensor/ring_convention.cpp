#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>

#include <tilth/core/median.hpp>
#include <tilth/sensor/beams.hpp>
#include <tilth/sensor/firing_order.hpp>
#include <tilth/sensor/ring_convention.hpp>
#include <tilth/sensor/sensor_mount.hpp>

namespace tilth {
namespace {

constexpr double kLargestRing = 1023;
constexpr double kClearRings = 0.7;  ///< of the points on their own ring: the axis need not be looked for
constexpr double kLeastRings = 0.4;  ///< the same: with less, and without another axis, a field names no rings
constexpr double kNear = 2.0;  ///< [m] nearer than this, elevation is blurred by where in the sensor a beam starts

bool is_ring(double value) {
  return value >= 0.0 && value <= kLargestRing && value == std::floor(value);
}

/// [rad] elevations of each value of the ring field in the frame of the sensor; none where a value can be no ring.
std::map<std::size_t, std::vector<double>> elevations_by_value(std::span<const MeasuredPoints> scans,
                                                               const Eigen::Isometry3d& T_cloud_sensor) {
  const Eigen::Isometry3d T_sensor_cloud = T_cloud_sensor.inverse();
  std::map<std::size_t, std::vector<double>> all;
  for (const MeasuredPoints& scan : scans) {
    if (!std::all_of(scan.ring_values.begin(), scan.ring_values.end(), is_ring)) return {};
    for (std::size_t i = 0; i < scan.ring_values.size(); ++i) {
      all[std::size_t(scan.ring_values[i])].push_back(elevation_of(T_sensor_cloud * scan.points[i]));
    }
  }
  return all;
}

/// [rad] median elevation of each value.
std::map<std::size_t, double> medians_of(const std::map<std::size_t, std::vector<double>>& by_value) {
  std::map<std::size_t, double> medians;
  for (const auto& [value, elevations] : by_value) medians[value] = median(elevations);
  return medians;
}

/// Share of the points that lie nearer to the median elevation of their value than to those of others: all of them,
/// where the values are rings about the z axis.
double ratio_on_rings(const std::map<std::size_t, std::vector<double>>& by_value) {
  std::vector<double> beams;
  for (const auto& [value, elevation] : medians_of(by_value)) beams.push_back(elevation);
  std::sort(beams.begin(), beams.end());
  std::size_t near = 0, all = 0;
  for (const auto& [value, elevations] : by_value) {
    const double centre = median(elevations);
    const double reach = 0.5 * spacing_at(beams, nearest_beam(beams, centre));
    near += std::size_t(
        std::count_if(elevations.begin(), elevations.end(), [&](double e) { return std::abs(e - centre) <= reach; }));
    all += elevations.size();
  }
  return double(near) / double(all);
}

/// " about an axis at (0.50, 0.00, 1.20) m, tilted by 10.0 deg found in the points".
std::string described(const Eigen::Isometry3d& T_cloud_sensor) {
  char text[128];
  const Eigen::Vector3d t = T_cloud_sensor.translation();
  const double tilt = std::acos(std::clamp(T_cloud_sensor.linear()(2, 2), -1.0, 1.0));
  std::snprintf(text, sizeof text, " about an axis at (%.2f, %.2f, %.2f) m, tilted by %.1f deg found in the points",
                t.x(), t.y(), t.z(), tilt * 180.0 / std::numbers::pi);
  return text;
}

std::vector<double> elevations_beyond(double range, std::span<const MeasuredPoints> scans) {
  constexpr std::size_t kEnough = 400000;  // points: of more, some are looked at
  std::size_t all = 0;
  for (const MeasuredPoints& scan : scans) all += scan.points.size();
  const std::size_t stride = 2 * (all / (2 * kEnough)) + 1;  // odd: beams fire in a pattern of even length
  std::vector<double> elevations;
  for (const MeasuredPoints& scan : scans) {
    for (std::size_t i = 0; i < scan.points.size(); i += stride) {
      if (scan.points[i].norm() > range) elevations.push_back(elevation_of(scan.points[i]));
    }
  }
  return elevations;
}

/// The rank by elevation of every value up to the largest; a value not seen takes the rank of the next lower one seen.
std::vector<std::uint16_t> ranked(const std::map<std::size_t, double>& elevation) {
  std::vector<std::pair<double, std::size_t>> order;
  for (const auto& [value, e] : elevation) order.emplace_back(e, value);
  std::sort(order.begin(), order.end());
  std::vector<std::uint16_t> rank(elevation.rbegin()->first + 1, 0);
  for (std::size_t r = 0; r < order.size(); ++r) rank[order[r].second] = std::uint16_t(r);
  for (std::size_t v = 1; v < rank.size(); ++v) {
    if (!elevation.contains(v)) rank[v] = rank[v - 1];
  }
  return rank;
}

}  // namespace

RingConvention::RingConvention(std::span<const MeasuredPoints> scans, const PointFieldRoles& roles) {
  if (roles.ring && decide_from_field(scans, roles.ring->name)) return;
  decide_from_points(scans);
  const std::string why = roles.ring ? "field '" + roles.ring->name + "' names no rings" : "no field";
  decision_ = "ring: " + why + ", " + decision_;
}

bool RingConvention::decide_from_field(std::span<const MeasuredPoints> scans, const std::string& name) {
  std::map<std::size_t, std::vector<double>> by_value = elevations_by_value(scans, Eigen::Isometry3d::Identity());
  if (by_value.size() < 2) return false;
  const double ratio = ratio_on_rings(by_value);
  if (ratio < kClearRings) T_cloud_sensor_ = find_mount_of_rings(scans);
  if (ratio < kLeastRings && !T_cloud_sensor_) return false;
  if (T_cloud_sensor_) by_value = elevations_by_value(scans, *T_cloud_sensor_);
  const std::map<std::size_t, double> elevation = medians_of(by_value);
  from_ = From::field;
  const auto falls = [](const auto& a, const auto& b) { return b.second < a.second; };
  const auto rises = [](const auto& a, const auto& b) { return b.second > a.second; };
  const std::string begin = "ring: field '" + name + "', " + std::to_string(elevation.size()) + " values" +
                            (T_cloud_sensor_ ? described(*T_cloud_sensor_) : std::string());
  if (std::adjacent_find(elevation.begin(), elevation.end(), falls) == elevation.end()) {
    decision_ = begin + ", 0 = lowest";
    return true;
  }
  const bool reversed = std::adjacent_find(elevation.begin(), elevation.end(), rises) == elevation.end();
  ring_of_value_ = ranked(elevation);
  decision_ = begin + (reversed ? ", 0 = highest, turned over" : " not in order of elevation, ranked by it");
  return true;
}

void RingConvention::decide_from_points(std::span<const MeasuredPoints> scans) {
  if (const auto rows = find_rows(scans.front().points)) {
    from_ = From::rows;
    decision_ = "derived from the order of storage: " + std::to_string(rows->size()) + " rings one after another";
    return;
  }
  beams_ = find_beams(elevations_beyond(0.0, scans));
  if (beams_.empty()) beams_ = find_beams(elevations_beyond(kNear, scans));
  if (!beams_.empty()) {
    from_ = From::beams;
    decision_ = "derived from elevation: " + std::to_string(beams_.size()) + " beams";
  } else if (std::optional<SensorMount> mount = find_mount(scans)) {
    from_ = From::beams;
    beams_ = std::move(mount->beams);
    T_cloud_sensor_ = mount->T_cloud_sensor;
    decision_ = std::to_string(beams_.size()) + " beams" + described(*T_cloud_sensor_);
  } else {
    decision_ =
        "and the points lie on no 8 to 128 beams about any axis: no rings, neighborhoods make the patches; with a "
        "narrow view, fast turns outdoors may be lost by tilth";
  }
}

std::vector<std::uint16_t> RingConvention::rings_of(const MeasuredPoints& scan) const {
  switch (from_) {
    case From::field: return rings_by_field(scan);
    case From::beams:
      return T_cloud_sensor_ ? nearest_beams(in_sensor_frame(scan.points, *T_cloud_sensor_), beams_)
                             : nearest_beams(scan.points, beams_);
    case From::rows: return rings_by_row(scan);
    case From::nothing: break;
  }
  return {};
}

std::vector<std::uint16_t> RingConvention::rings_by_field(const MeasuredPoints& scan) const {
  if (!std::all_of(scan.ring_values.begin(), scan.ring_values.end(), is_ring)) return {};
  std::vector<std::uint16_t> rings(scan.ring_values.size());
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const std::size_t value = std::size_t(scan.ring_values[i]);
    rings[i] =
        ring_of_value_.empty() ? std::uint16_t(value) : ring_of_value_[std::min(value, ring_of_value_.size() - 1)];
  }
  return rings;
}

std::vector<std::uint16_t> RingConvention::rings_by_row(const MeasuredPoints& scan) const {
  const auto first = find_rows(scan.points);
  if (!first) return {};
  std::vector<std::uint16_t> rings(scan.points.size());
  const bool downwards = elevation_of(scan.points.front()) > elevation_of(scan.points.back());
  for (std::size_t row = 0; row < first->size(); ++row) {
    const std::size_t end = row + 1 < first->size() ? (*first)[row + 1] : rings.size();
    const std::size_t ring = downwards ? first->size() - 1 - row : row;
    std::fill(rings.begin() + std::ptrdiff_t((*first)[row]), rings.begin() + std::ptrdiff_t(end), std::uint16_t(ring));
  }
  return rings;
}

}  // namespace tilth
