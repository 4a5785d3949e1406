// Second moments of the points around each point, from a table of neighbours: Sigma_i of Fu et al. 2026, sections 3
// and 4. One pass over the table, a few vector operations for each neighbour.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <tilth/core/point_cloud.hpp>
#include <tilth/core/symmetric3.hpp>
#include <tilth/search/scan_neighbors.hpp>

namespace tilth {

/// Sample covariances [m^2], those of all points as structure of arrays.
struct LocalCovariances {
  std::vector<float> xx, yy, zz, xy, yz, xz;
  std::vector<std::uint8_t> counts;  ///< neighbours that were kept; below two a covariance is zero

  std::size_t size() const { return xx.size(); }
  Eigen::Matrix3f matrix(std::size_t i) const {
    return Symmetric3f{{xx[i], yy[i], zz[i], xy[i], yz[i], xz[i]}}.matrix();
  }
};

/// 1/(m - 1) sum (q - mean)(q - mean)^T over the m neighbours q of each point that are kept (`keep` not 0); all are
/// where `keep` is empty. The point itself is not one of them. At most 255 neighbours. O(n k).
LocalCovariances local_covariances(const PointCloud& cloud, const NeighborTable& neighbors,
                                   std::span<const std::uint8_t> keep = {});

/// local_covariances() for scan after scan: keeps its buffers, so that after the first scans nothing is allocated.
class NeighborMoments {
 public:
  /// The covariances; they hold until the next call.
  const LocalCovariances& compute(const PointCloud& cloud, const NeighborTable& neighbors,
                                  std::span<const std::uint8_t> keep = {});

 private:
  std::vector<Eigen::Array4f> points_;  // x, y, z and 1 (kept) or 0: one aligned load
  LocalCovariances covariances_;
};

}  // namespace tilth
