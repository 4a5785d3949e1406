#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <tilth/core/median.hpp>
#include <tilth/preprocess/sparse_beams.hpp>

namespace tilth {
namespace {

constexpr std::uint16_t kLeftOut = std::numeric_limits<std::uint16_t>::max();

/// [deg] of each ring; not a number where it has no points.
std::vector<double> elevations_of(const PointCloud& cloud) {
  const std::size_t count = std::size_t(*std::max_element(cloud.rings.begin(), cloud.rings.end())) + 1;
  std::vector<std::vector<double>> all(count);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d& p = cloud.points[i];
    all[cloud.rings[i]].push_back(std::atan2(p.z(), p.head<2>().norm()) * 180 / std::numbers::pi);
  }
  std::vector<double> elevations;
  for (const std::vector<double>& ring : all)
    elevations.push_back(ring.empty() ? std::numeric_limits<double>::quiet_NaN() : median(ring));
  return elevations;
}

/// What each ring becomes.
std::vector<std::uint16_t> renumbered(const std::vector<double>& elevations, double spacing) {
  std::vector<std::uint16_t> rings(elevations.size(), kLeftOut);
  double last = -std::numeric_limits<double>::infinity();
  std::uint16_t next = 0;
  for (std::size_t i = 0; i < elevations.size(); ++i) {
    if (!(std::abs(elevations[i] - last) >= spacing)) continue;
    last = elevations[i];
    rings[i] = next++;
  }
  return rings;
}

}  // namespace

PointCloud sparse_beams(PointCloud cloud, double spacing) {
  if (!cloud.has_rings()) return cloud;
  const std::vector<double> elevations = elevations_of(cloud);
  const std::vector<std::uint16_t> to = renumbered(elevations, spacing);
  const auto seen = std::count_if(elevations.begin(), elevations.end(), [](double e) { return !std::isnan(e); });
  if (std::count(to.begin(), to.end(), kLeftOut) == std::ptrdiff_t(elevations.size()) - seen) return cloud;
  std::vector<std::uint8_t> keep(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    keep[i] = to[cloud.rings[i]] != kLeftOut;
    cloud.rings[i] = to[cloud.rings[i]];
  }
  return select_kept(cloud, keep);
}

}  // namespace tilth
