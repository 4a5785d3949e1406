#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <tilth/core/evenly_chosen.hpp>
#include <tilth/sensor/beams.hpp>
#include <tilth/sensor/sensor_mount.hpp>

namespace tilth {
namespace {

constexpr std::size_t kScans = 4;             // looked at
constexpr std::size_t kArcsOfScan = 1000;     // at most
constexpr std::size_t kFewestArcs = 60;       // that tell of an axis
constexpr double kLargestError = 0.1;         // [rad] between arcs and rings
constexpr std::size_t kPointsOfRing = 200;    // of a scan, where rings are known
constexpr std::size_t kPointsOfScan = 20000;  // by which whole rings are fitted
constexpr std::size_t kFewestPoints = 10;     // of a whole ring
constexpr double kOnBeam = 0.3;               // of the distance to the next beam
constexpr double kClearRing = 2e-3;           // [rad] of a ring about its cone, where the field tells rings
constexpr int kRounds = 3, kSteps = 8;

/// Places after which a beam's next point is looked for, 0: among neighbours, whatever their order. Sensors whose beams
/// lie nearer to one another than their columns have other beams of the same firing nearer.
constexpr std::array<std::size_t, 4> kFirstAfter{5, 0, 60, 120};

RingArcs arcs_of(std::span<const MeasuredPoints> scans, std::size_t first_after) {
  RingArcs arcs;
  for (const MeasuredPoints& scan : scans) {
    if (first_after > 0)
      add_arcs_in_order(scan.points, first_after, kArcsOfScan, arcs);
    else
      add_arcs_of_neighbors(scan.points, kArcsOfScan, arcs);
  }
  return arcs;
}

/// From one point that is looked at to the next: odd, for beams fire in a pattern of even length.
std::size_t stride_of(const MeasuredPoints& scan) {
  return 2 * (scan.points.size() / (2 * kPointsOfScan)) + 1;
}

std::vector<double> elevations_about(const Eigen::Isometry3d& T_cloud_sensor, std::span<const MeasuredPoints> scans) {
  const Eigen::Isometry3d T_sensor_cloud = T_cloud_sensor.inverse();
  std::vector<double> elevations;
  for (const MeasuredPoints& scan : scans) {
    const std::size_t stride = stride_of(scan);
    for (std::size_t i = 0; i < scan.points.size(); i += stride)
      elevations.push_back(elevation_of(T_sensor_cloud * scan.points[i]));
  }
  return elevations;
}

/// The points on each beam, as one arc.
RingArcs whole_rings(std::span<const MeasuredPoints> scans, const SensorMount& mount) {
  const Eigen::Isometry3d T_sensor_cloud = mount.T_cloud_sensor.inverse();
  std::vector<std::vector<Eigen::Vector3d>> rings(mount.beams.size());
  for (const MeasuredPoints& scan : scans) {
    const std::size_t stride = stride_of(scan);
    for (std::size_t i = 0; i < scan.points.size(); i += stride) {
      const double elevation = elevation_of(T_sensor_cloud * scan.points[i]);
      const std::size_t beam = nearest_beam(mount.beams, elevation);
      if (std::abs(elevation - mount.beams[beam]) < kOnBeam * spacing_at(mount.beams, beam))
        rings[beam].push_back(scan.points[i]);
    }
  }
  RingArcs arcs;
  for (const auto& ring : rings) {
    if (ring.size() >= kFewestPoints) arcs.add(ring);
  }
  return arcs;
}

std::optional<SensorMount> refined(std::span<const MeasuredPoints> scans, SensorAxis axis) {
  SensorMount mount;
  for (int round = 0; round < kRounds; ++round) {
    mount.T_cloud_sensor = axis.T_cloud_sensor();
    mount.beams = find_beams(elevations_about(mount.T_cloud_sensor, scans));
    if (mount.beams.empty()) return std::nullopt;
    if (round + 1 < kRounds) axis = fit_axis(whole_rings(scans, mount), axis, kSteps);
  }
  return mount;
}

}  // namespace

std::optional<SensorMount> find_mount(std::span<const MeasuredPoints> scans) {
  scans = scans.first(std::min(kScans, scans.size()));
  for (const std::size_t first_after : kFirstAfter) {
    const RingArcs arcs = arcs_of(scans, first_after);
    if (arcs.size() < kFewestArcs) continue;
    const SensorAxis axis = search_axis(arcs);
    if (!(axis.error < kLargestError)) continue;  // nor where it is no number
    if (std::optional<SensorMount> mount = refined(scans, axis)) return mount;
  }
  return std::nullopt;
}

std::optional<Eigen::Isometry3d> find_mount_of_rings(std::span<const MeasuredPoints> scans) {
  RingArcs arcs;
  for (const MeasuredPoints& scan : scans.first(std::min(kScans, scans.size()))) {
    std::map<double, std::vector<Eigen::Vector3d>> rings;
    for (std::size_t i = 0; i < scan.points.size(); ++i) rings[scan.ring_values[i]].push_back(scan.points[i]);
    for (const auto& [value, ring] : rings) {
      const std::size_t stride = stride_of(ring.size(), kPointsOfRing);
      std::vector<Eigen::Vector3d> some;
      for (std::size_t i = 0; i < ring.size(); i += stride) some.push_back(ring[i]);
      if (some.size() >= kFewestPoints) arcs.add(some);
    }
  }
  if (arcs.size() == 0) return std::nullopt;
  const SensorAxis axis = search_axis(arcs);
  if (!(axis.error < kClearRing)) return std::nullopt;
  return axis.T_cloud_sensor();
}

std::vector<Eigen::Vector3d> in_sensor_frame(std::span<const Eigen::Vector3d> points,
                                             const Eigen::Isometry3d& T_cloud_sensor) {
  const Eigen::Isometry3d T_sensor_cloud = T_cloud_sensor.inverse();
  std::vector<Eigen::Vector3d> seen;
  seen.reserve(points.size());
  for (const Eigen::Vector3d& p : points) seen.push_back(T_sensor_cloud * p);
  return seen;
}

}  // namespace tilth
