// What LeGO-LOAM (Shan and Englot 2018) makes of a scan: ground and clusters, and edge and plane points of them. O(n
// log n).
#pragma once

#include <tilth/features/ground.hpp>
#include <tilth/features/row_scan.hpp>

namespace tilth {

struct SegmentationOptions {
  RangeImageOptions image;
  GroundOptions ground;
  ClusterOptions clusters;
  int thinning = 5;
};

template <class V>
void visit(SegmentationOptions& o, V&& v) {
  v("image", o.image, "[-] range image");
  v("ground", o.ground, "[-] ground");
  v("clusters", o.clusters, "[-] clusters of what is not ground");
  v("thinning", o.thinning, Bounds{1, 1000}, "[columns] one of so many is kept of the ground, and of noise above it");
}

struct SegmentedScan {
  RowScan rows;                      ///< clusters, and the ground thinned
  std::vector<std::uint8_t> ground;  ///< 1 for each point of `rows` on the ground
  PointCloud outliers;               ///< noise above the rows of the ground, thinned
  std::vector<std::uint8_t> keep;    ///< 0 for each point of the cloud whose cluster is noise
};

SegmentedScan segment(const PointCloud& cloud, const SegmentationOptions& options);

struct LegoFeatureOptions {
  double edge_threshold = 0.1;
  double plane_threshold = 0.1;
  int sharp = 2;
  int less_sharp = 20;
  int flat = 4;
  double less_flat_voxel = 0.2;
  bool sort_all_but_last = false;
};

template <class V>
void visit(LegoFeatureOptions& o, V&& v) {
  v("edge_threshold", o.edge_threshold, Bounds{0, 1e6}, "[m^2] curvature of an edge point, at least");
  v("plane_threshold", o.plane_threshold, Bounds{0, 1e6}, "[m^2] curvature of a plane point, at most");
  v("sharp", o.sharp, Bounds{0, 1000}, "[points] sharpest edges of a sector, six a row: matched with the last scan");
  v("less_sharp", o.less_sharp, Bounds{0, 1000}, "[points] edges of a sector, these included: what is matched with");
  v("flat", o.flat, Bounds{0, 1000}, "[points] flattest of the ground of a sector: matched with the last scan");
  v("less_flat_voxel", o.less_flat_voxel, Bounds{0.01, 100},
    "[m] grid of each row's points that are no edges: what flat ones are matched with");
  v("sort_all_but_last", o.sort_all_but_last,
    "[-] as LeGO-LOAM: the last point of a sector counts as the most curved, whatever it is");
}

/// Edges off the ground and planes on it. Each cloud goes from row to row upwards and has rings.
struct LegoFeatures {
  PointCloud sharp, less_sharp, flat, less_flat;
};

LegoFeatures lego_features(const SegmentedScan& scan, const LegoFeatureOptions& options);

}  // namespace tilth
