#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include <tilth/sensor/beams.hpp>
#include <tilth/sensor/firing_order.hpp>
#include <tilth/sensor/ring_convention.hpp>

namespace tilth {
namespace {

constexpr double kLargestRing = 1023;
constexpr double kNear = 2.0;  ///< [m] nearer than this, elevation is blurred by where in the sensor a beam starts

bool is_ring(double value) {
  return value >= 0.0 && value <= kLargestRing && value == std::floor(value);
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// [rad] median elevation of each value of the ring field; none where a value can be no ring.
std::map<std::size_t, double> elevation_by_value(std::span<const MeasuredPoints> scans) {
  std::map<std::size_t, std::vector<double>> all;
  for (const MeasuredPoints& scan : scans) {
    if (!std::all_of(scan.ring_values.begin(), scan.ring_values.end(), is_ring)) return {};
    for (std::size_t i = 0; i < scan.ring_values.size(); ++i) {
      all[std::size_t(scan.ring_values[i])].push_back(elevation_of(scan.points[i]));
    }
  }
  std::map<std::size_t, double> medians;
  for (const auto& [value, elevations] : all) medians[value] = median(elevations);
  return medians;
}

std::vector<double> elevations_beyond(double range, std::span<const MeasuredPoints> scans) {
  std::vector<double> elevations;
  for (const MeasuredPoints& scan : scans) {
    for (const Eigen::Vector3d& p : scan.points) {
      if (p.norm() > range) elevations.push_back(elevation_of(p));
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
  const std::map<std::size_t, double> elevation = elevation_by_value(scans);
  if (elevation.size() < 2) return false;
  from_ = From::field;
  const auto falls = [](const auto& a, const auto& b) { return b.second < a.second; };
  const auto rises = [](const auto& a, const auto& b) { return b.second > a.second; };
  const std::string begin = "ring: field '" + name + "', " + std::to_string(elevation.size()) + " values";
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
  if (beams_.empty()) {
    decision_ = "and the points lie on no 8 to 128 distinct elevations: no rings";
    return;
  }
  from_ = From::beams;
  decision_ = "derived from elevation: " + std::to_string(beams_.size()) + " beams";
}

std::vector<std::uint16_t> RingConvention::rings_of(const MeasuredPoints& scan) const {
  switch (from_) {
    case From::field: return rings_by_field(scan);
    case From::beams: return nearest_beams(scan.points, beams_);
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
