// Statistical outlier removal (SOR): Fu et al. 2026, section 2.3, with distance weights and a density-adaptive
// threshold, beside the plain filter that PCL has and one made for spinning LiDARs (ring_support.hpp). Works on a table
// of neighbours that other stages share.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <tilth/core/options.hpp>
#include <tilth/core/point_cloud.hpp>
#include <tilth/preprocess/ring_support.hpp>
#include <tilth/search/scan_neighbors.hpp>

namespace tilth {

enum class OutlierMethod { none, plain, weighted, support };
inline std::span<const std::string_view> names_of(OutlierMethod) {
  static constexpr std::array<std::string_view, 4> names{"none", "plain", "weighted", "support"};
  return names;
}

/// The density term g of the threshold, as a function of x = rho_i / rho_avg; the paper's text allows two readings.
enum class DensityTerm { none, inverse, difference };
inline std::span<const std::string_view> names_of(DensityTerm) {
  static constexpr std::array<std::string_view, 3> names{"none", "inverse", "difference"};
  return names;
}

/// The ball whose volume makes a density: the one about the point that holds its neighbours, or the smallest one that
/// holds them, wherever its center is (the paper's "minimum bounding sphere").
enum class DensityBall { about_point, smallest };
inline std::span<const std::string_view> names_of(DensityBall) {
  static constexpr std::array<std::string_view, 2> names{"about_point", "smallest"};
  return names;
}

struct OutlierOptions {
  OutlierMethod method = OutlierMethod::support;
  int k = 10;
  double alpha = 1.0;
  DensityTerm density = DensityTerm::inverse;
  double density_min = 0.0;
  double density_max = 1.0;
  bool per_range = true;
  DensityBall ball = DensityBall::about_point;
  RingSupportOptions support = {};
};

template <class V>
void visit(OutlierOptions& o, V&& v) {
  v("method", o.method,
    "[-] support: by the beams beside a point (clouds without rings: by company in a cell); weighted: distances "
    "weighted and "
    "threshold adapted to density; plain: mean + alpha sigma, as PCL");
  v("k", o.k, Bounds{2, 64}, "[points] nearest neighbours of each point");
  v("alpha", o.alpha, Bounds{0, 100}, "[-] width of the threshold in standard deviations");
  v("density", o.density, "[-] density term g(x) of the threshold, x = density / mean density: 1/x, or 1 - x",
    kAdvanced);
  v("density_min", o.density_min, Bounds{-1e9, 1e9}, "[-] least value of the density term", kAdvanced);
  v("density_max", o.density_max, Bounds{-1e9, 1e9}, "[-] greatest value of the density term", kAdvanced);
  v("per_range", o.per_range, "[-] measure distances in units of the range: a spinning LiDAR's spacing grows with it",
    kAdvanced);
  v("ball", o.ball,
    "[-] density: k / volume of the ball about a point that holds its neighbours, or of the smallest one", kAdvanced);
  visit(o.support, v);
}

/// For each point of a cloud 1 (kept) or 0 (outlier). Keeps its buffers for scan after scan; a result holds until the
/// next call. O(n k), O(n) by `support`.
class OutlierFilter {
 public:
  explicit OutlierFilter(const OutlierOptions& options) : options_(options) {}

  /// By each point's row of `neighbors` or, by `support`, by the beams beside it.
  const std::vector<std::uint8_t>& keep(const PointCloud& cloud, const NeighborTable& neighbors);

  /// The same of a cloud laid out as `rings`, with neighbours looked for only where the method needs them.
  const std::vector<std::uint8_t>& keep(const PointCloud& cloud, const RingLayout& rings);

 private:
  bool is_by_support() const { return options_.method == OutlierMethod::support; }
  const std::vector<std::uint8_t>& keep_by_distance(const PointCloud& cloud, const NeighborTable& neighbors);

  OutlierOptions options_;
  ScanNeighbors neighbors_;
  std::vector<float> scale_, means_, densities_;  // a point each
  std::vector<std::uint8_t> keep_;
};

/// What a filter keeps of one scan.
std::vector<std::uint8_t> keep_inliers(const PointCloud& cloud, const NeighborTable& neighbors,
                                       const OutlierOptions& options);

}  // namespace tilth
