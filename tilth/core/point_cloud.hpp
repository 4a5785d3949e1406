// A cloud of points as a struct of arrays: an attribute has one entry per point, or none at all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace tilth {

struct PointCloud {
  std::vector<Eigen::Vector3d> points;  ///< [m], in the LiDAR frame unless the variable's name says otherwise
  std::vector<float> intensities;       ///< as the sensor gives them
  std::vector<float> times;             ///< [s] >= 0, since the stamp of the scan (its first point)
  std::vector<std::uint16_t> rings;     ///< 0 = lowest beam

  std::size_t size() const { return points.size(); }
  bool empty() const { return points.empty(); }
  bool has_times() const { return !times.empty() && times.size() == points.size(); }
  bool has_rings() const { return !rings.empty() && rings.size() == points.size(); }
};

/// The points at `indices`, with every attribute that `cloud` has, in the order of `indices`.
PointCloud select(const PointCloud& cloud, std::span<const std::uint32_t> indices);

/// The points whose entry in `keep`, one a point, is not zero.
PointCloud select_kept(const PointCloud& cloud, std::span<const std::uint8_t> keep);

/// [s] from the stamp of the scan to its last point; 0 without times.
double duration(const PointCloud& cloud);

/// `cloud` moved by T_target_source. O(n).
PointCloud transform(const PointCloud& cloud, const Eigen::Isometry3d& T_target_source);

/// Appends `more` to `cloud`. An attribute survives only if both have it (an empty `cloud` takes all of `more`).
void append(PointCloud& cloud, const PointCloud& more);

}  // namespace tilth
