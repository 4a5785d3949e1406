// Edge and plane points as LIO-SAM (Shan et al. 2020) takes them: of each of six sectors of a row of the range image
// the most curved points are edges, and all others are planes, thinned row by row. O(n log n).
#pragma once

#include <tilth/core/feature_clouds.hpp>
#include <tilth/core/options.hpp>
#include <tilth/features/range_image.hpp>

namespace tilth {

struct LioSamFeatureOptions {
  RangeImageOptions image{.cell_keeps = CellKeeps::first_return};
  double edge_threshold = 1.0;
  int edges = 20;
  double plane_voxel = 0.2;
  bool sort_all_but_last = false;
};

template <class V>
void visit(LioSamFeatureOptions& o, V&& v) {
  v("image", o.image, "[-] range image");
  v("edge_threshold", o.edge_threshold, Bounds{0, 1e6}, "[m^2] curvature of an edge point, more than");
  v("edges", o.edges, Bounds{0, 1000}, "[points] edges of a sector, six a row, at most");
  v("plane_voxel", o.plane_voxel, Bounds{0.01, 100}, "[m] grid of each row's points that are no edges");
  v("sort_all_but_last", o.sort_all_but_last,
    "[-] as LIO-SAM: the last point of a sector counts as the most curved, whatever it is");
}

/// Edges and planes of `cloud`, from row to row upwards, with its attributes.
FeatureClouds lio_sam_features(const PointCloud& cloud, const LioSamFeatureOptions& options);

}  // namespace tilth
