#include "filter_trial.hpp"

#include <tilth/core/parallel.hpp>
#include <tilth/search/neighbor_moments.hpp>

namespace tilth::app {
namespace {

FeatureCounts features_of(const LabelledCloud& scan, const NeighborTable& neighbors, std::span<const std::uint8_t> keep,
                          const FeatureOptions& options) {
  const LocalCovariances sigma = local_covariances(scan.cloud, neighbors, keep);
  std::vector<float> curvature(scan.cloud.size());
  for (std::size_t i = 0; i < curvature.size(); ++i) {
    curvature[i] = keep.empty() || keep[i] ? corrected_curvature(sigma.matrix(i)) : 0;
  }
  return count_features(scan.labels, select_edges(scan.cloud, curvature, options),
                        select_planes(scan.cloud, curvature, options));
}

LabelledCloud cropped(const LabelledCloud& scan, const ImprovedFloamOptions& options) {
  LabelledCloud in_range;
  std::vector<std::uint32_t> indices;
  for (std::uint32_t i = 0; i < scan.cloud.size(); ++i) {
    const double range = scan.cloud.points[i].norm();
    if (range < options.min_range || range > options.max_range) continue;
    indices.push_back(i);
    in_range.labels.push_back(scan.labels[i]);
    in_range.obvious.push_back(scan.obvious[i]);
  }
  in_range.cloud = select(scan.cloud, indices);
  return in_range;
}

FilterScore try_scan(const LabelledCloud& whole, const ImprovedFloamOptions& options) {
  const LabelledCloud scan = cropped(whole, options);
  const NeighborTable neighbors = scan_neighbors(scan.cloud, std::size_t(options.outliers.k));
  const std::vector<std::uint8_t> keep = keep_inliers(scan.cloud, neighbors, options.outliers);
  FilterScore score = score_filter(scan, keep);
  score.features_before = features_of(scan, neighbors, {}, options.features);
  score.features_after = features_of(scan, neighbors, keep, options.features);
  return score;
}

}  // namespace

FilterScore try_filter(std::span<const LabelledCloud> scans, const ImprovedFloamOptions& options) {
  return parallel_sum<FilterScore>(scans.size(), 1, [&](std::size_t begin, std::size_t end) {
    FilterScore score;
    for (std::size_t i = begin; i < end; ++i) score += try_scan(scans[i], options);
    return score;
  });
}

std::vector<OptionInfo> describe_filter(const ImprovedFloamOptions& options) {
  std::vector<OptionInfo> rows = describe(options);
  std::erase_if(rows, [](const OptionInfo& row) {
    const std::string_view key = row.key;
    return !key.starts_with("outliers.") && !key.starts_with("features.") && !key.ends_with("_range");
  });
  return rows;
}

}  // namespace tilth::app
