#include <tilth/core/voxel_downsample.hpp>
#include <tilth/features/lio_sam_features.hpp>
#include <tilth/features/row_scan.hpp>

namespace tilth {

FeatureClouds lio_sam_features(const PointCloud& cloud, const LioSamFeatureOptions& options) {
  const RangeImage image = project(cloud, options.image);
  const RowScan scan = row_scan(cloud, image, std::vector<std::uint8_t>(image.points.size(), 1));
  const std::vector<double> curvature = range_curvature(scan.ranges);
  std::vector<std::uint8_t> picked = unusable_points(scan), is_edge(picked.size(), 0);
  std::vector<std::uint32_t> edges;
  const auto choose_edges = [&](const Sector& sector) {
    const std::vector<std::uint32_t> order = by_curvature(sector, curvature, options.sort_all_but_last);
    int count = 0;
    for (auto i = order.rbegin(); i != order.rend() && count < options.edges; ++i) {
      if (picked[*i] || !(curvature[*i] > options.edge_threshold)) continue;
      ++count;
      edges.push_back(*i);
      is_edge[*i] = 1;
      suppress_around(*i, scan.columns, picked);
    }
  };
  FeatureClouds features;
  for (std::size_t row = 0; row < scan.rows(); ++row) {
    std::vector<std::uint32_t> planes;
    for (const Sector& sector : sectors_of_row(scan, row)) {
      choose_edges(sector);
      for (std::size_t i = sector.begin; i < sector.end; ++i) {
        if (!is_edge[i]) planes.push_back(std::uint32_t(i));
      }
    }
    append(features.planes, voxel_downsample(select(scan.cloud, planes), options.plane_voxel));
  }
  features.edges = select(scan.cloud, edges);
  return features;
}

}  // namespace tilth
