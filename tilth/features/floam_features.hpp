// Edge and plane points as FLOAM (Wang et al. 2021) takes them: of each of six sectors of a ring the most curved
// points are edges, and all that is neither edge nor beside one is plane. O(n log n).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <tilth/core/feature_clouds.hpp>
#include <tilth/core/options.hpp>
#include <tilth/features/curvature.hpp>

namespace tilth {

struct FloamFeatureOptions {
  int min_ring_points = 131;
  Curvature curvature = Curvature::floam;
  double edge_threshold = 0.1;
  int edges = 20;
  int planes = 0;
  double max_gap = 0.22360679774997896;
  bool skip_sector_ends = false;
};

template <class V>
void visit(FloamFeatureOptions& o, V&& v) {
  v("min_ring_points", o.min_ring_points, Bounds{11, 1e6}, "[points] a ring of fewer gives no features");
  v("curvature", o.curvature,
    "[-] floam: of the points, in m^2; loam: the same per range and point, as LOAM's paper; lio_sam: of the ranges");
  v("edge_threshold", o.edge_threshold, Bounds{0, 1e9}, "[m^2, loam: -] curvature of an edge point, more than");
  v("edges", o.edges, Bounds{0, 1e6}, "[points] edges of a sector, six a ring, at most");
  v("planes", o.planes, Bounds{0, 1e6}, "[points] planes of a sector, the least curved, at most; 0: all", kAdvanced);
  v("max_gap", o.max_gap, Bounds{0, 1e3},
    "[m] between neighbours, beyond which an edge point rules out no more of the five on either side (sqrt 0.05)",
    kAdvanced);
  v("skip_sector_ends", o.skip_sector_ends, "[-] as FLOAM: the last point of each sector is nothing", kAdvanced);
}

/// Points of a cloud by their numbers, ring by ring.
struct FeatureIndices {
  std::vector<std::uint32_t> edges, planes;
};

/// The features of `cloud` by a curvature given for each of its points, in whatever unit options.edge_threshold has;
/// options.curvature is not asked. Order as below.
FeatureIndices choose_floam_features(const PointCloud& cloud, std::span<const double> curvature,
                                     const FloamFeatureOptions& options);

/// Edges and planes of `cloud`, ring by ring, with their attributes. The points of each ring must come in the order of
/// their firing; a cloud without rings counts as one ring.
FeatureClouds floam_features(const PointCloud& cloud, const FloamFeatureOptions& options);

}  // namespace tilth
