// Exact k nearest neighbours of every point of a ring-ordered scan, without a tree: what a spinning LiDAR measures in
// another direction is at least |p| sin(angle) away, so that a search ends after a few columns of a few rings.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <tilth/core/point_cloud.hpp>

namespace tilth {

/// The k nearest neighbours of each of n points (the point itself excluded), nearest first.
struct NeighborTable {
  std::size_t k = 0;                     ///< columns; fewer than asked for where the cloud has fewer than k + 1 points
  std::vector<std::uint32_t> indices;    ///< n x k, row by row
  std::vector<float> squared_distances;  ///< [m^2] n x k, ascending in each row

  std::size_t size() const { return k == 0 ? 0 : indices.size() / k; }
  std::span<const std::uint32_t> neighbors(std::size_t i) const { return {indices.data() + i * k, k}; }
  std::span<const float> distances(std::size_t i) const { return {squared_distances.data() + i * k, k}; }
};

/// The k nearest neighbours of every point. Uses the order of rings and firings where the cloud has one, else a
/// kd-tree; the result is the same set of distances either way. Points must be finite.
NeighborTable scan_neighbors(const PointCloud& cloud, std::size_t k);

/// scan_neighbors() for scan after scan: keeps its buffers, so that after the first scans nothing is allocated.
class ScanNeighbors {
 public:
  ScanNeighbors();
  ScanNeighbors(ScanNeighbors&&) noexcept;
  ScanNeighbors& operator=(ScanNeighbors&&) noexcept;
  ~ScanNeighbors();

  /// The table of `cloud`; it holds until the next call.
  const NeighborTable& compute(const PointCloud& cloud, std::size_t k);

 private:
  struct Buffers;
  std::unique_ptr<Buffers> buffers_;
};

}  // namespace tilth
