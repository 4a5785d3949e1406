// What a filter of points did to labelled scans: shares removed and kept by what the points are, and false features
// before and after it. The figures that section 2.3 of Fu et al. 2026 claims for its outlier removal.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <tilth/core/point_cloud.hpp>
#include <tilth/core/point_label.hpp>

namespace tilth {

/// Points of one sort before a filter, and those that it kept.
struct KeptCount {
  std::size_t before = 0, kept = 0;

  double kept_ratio() const { return before == 0 ? 1.0 : double(kept) / double(before); }
  double removed_ratio() const { return before == 0 ? 0.0 : 1.0 - double(kept) / double(before); }
  KeptCount& operator+=(const KeptCount& more);
};

/// Features by what their points are. False: outlier, mixed or ghost; off edge: true, but not on an edge structure.
struct FeatureCounts {
  std::size_t edges = 0, false_edges = 0, off_edge = 0, planes = 0, false_planes = 0;

  double false_edge_ratio() const { return edges == 0 ? 0.0 : double(false_edges) / double(edges); }
  double off_edge_ratio() const { return edges == 0 ? 0.0 : double(off_edge) / double(edges); }
  double false_ratio() const;  ///< of all features
  FeatureCounts& operator+=(const FeatureCounts& more);
};

struct FilterScore {
  /// [m] upper ends of the ranges by which surface points are counted; the last has none.
  static constexpr std::array<double, 5> kRanges{2, 5, 10, 20, 40};

  std::size_t scans = 0;
  std::array<KeptCount, 5> kinds;             ///< by PointKind
  KeptCount obvious;                          ///< false points that lie clear of every surface
  KeptCount edges;                            ///< surface points on an edge structure
  std::array<KeptCount, 6> surface_by_range;  ///< surface points by kRanges
  FeatureCounts features_before, features_after;

  const KeptCount& of(PointKind kind) const { return kinds[std::size_t(kind)]; }
  KeptCount false_points() const;   ///< outlier, mixed and ghost
  double accuracy() const;          ///< share of the points that were judged rightly: false removed, others kept
  double precision() const;         ///< share of what was removed that is false
  double pseudo_reduction() const;  ///< share of the false edge features that the filter did away with
  FilterScore& operator+=(const FilterScore& more);
};

/// One scan with its truth.
struct LabelledCloud {
  PointCloud cloud;
  std::vector<std::uint8_t> labels;   ///< one a point
  std::vector<std::uint8_t> obvious;  ///< mark_obvious()
};

inline constexpr double kObviousClearance = 0.3;  ///< [m]

/// For each point 1 where it is labelled outlier or mixed and no point labelled surface lies within kObviousClearance.
/// O(false points x points).
std::vector<std::uint8_t> mark_obvious(const PointCloud& cloud, std::span<const std::uint8_t> labels);

/// Counts one scan; `keep` has 1 (kept) or 0 for each point. Features are left at zero. Throws Error where the lengths
/// differ.
FilterScore score_filter(const LabelledCloud& scan, std::span<const std::uint8_t> keep);

/// Counts features given by their indices into the labelled scan.
FeatureCounts count_features(std::span<const std::uint8_t> labels, std::span<const std::uint32_t> edges,
                             std::span<const std::uint32_t> planes);

}  // namespace tilth
