// Edge points of a scan, evenly over rings and sectors (FLOAM's scheme: six sectors a ring), and plane points, evenly
// over space, by the corrected curvature of Fu et al. 2026, section 2.3: kappa = tr(Sigma) / |Sigma|_F, 1 on a line,
// sqrt 2 on a patch, sqrt 3 in a blob.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <tilth/core/options.hpp>
#include <tilth/core/point_cloud.hpp>

namespace tilth {

struct FeatureOptions {
  int sectors = 6;
  int edges = 280;
  int planes = 820;
  double min_edge_curvature = 1.15;
  double max_plane_curvature = 1.73;
  double plane_cell = 0.3;
  int edge_spacing = 5;
};

template <class V>
void visit(FeatureOptions& o, V&& v) {
  v("sectors", o.sectors, Bounds{1, 360}, "[-] equal parts of each ring");
  v("edges", o.edges, Bounds{0, 1e6}, "[points] edge features of a scan, shared equally among all sectors");
  v("planes", o.planes, Bounds{0, 1e6}, "[points] plane features of a scan, at most");
  v("min_edge_curvature", o.min_edge_curvature, Bounds{1, 1.7320508},
    "[-] least curvature of an edge point, of 1 .. sqrt 3");
  v("max_plane_curvature", o.max_plane_curvature, Bounds{1, 1.7320508}, "[-] greatest curvature of a plane point");
  v("plane_cell", o.plane_cell, Bounds{0.01, 100}, "[m] side of the cells that give one plane point each");
  v("edge_spacing", o.edge_spacing, Bounds{0, 100}, "[points] neighbours along the ring that an edge point rules out");
}

/// kappa = tr(Sigma) / |Sigma|_F of a covariance [m^2]; 0 where it is zero.
float corrected_curvature(const Eigen::Matrix3f& sigma);

/// The most curved points of each sector, as indices. `curvature` holds a value per point, 0 for points that are no
/// candidates. A cloud without rings counts as one ring. O(n log n) at worst.
std::vector<std::uint32_t> select_edges(const PointCloud& cloud, std::span<const float> curvature,
                                        const FeatureOptions& options);

/// The least curved point of each cell of a grid, likewise.
std::vector<std::uint32_t> select_planes(const PointCloud& cloud, std::span<const float> curvature,
                                         const FeatureOptions& options);

}  // namespace tilth
