#include <algorithm>
#include <string>

#include <tilth/core/error.hpp>
#include <tilth/evaluation/filter_score.hpp>

namespace tilth {
namespace {

bool is_false(std::uint8_t label) {
  const PointKind kind = kind_of(label);
  return kind == PointKind::outlier || kind == PointKind::mixed || kind == PointKind::ghost;
}

double ratio(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : double(part) / double(whole);
}

void check_length(const char* what, std::size_t length, std::size_t points) {
  if (length == points) return;
  throw Error(what, "has " + std::to_string(length) + " entries for " + std::to_string(points) + " points");
}

std::size_t range_of(const Eigen::Vector3d& point) {
  const auto& ends = FilterScore::kRanges;
  return std::size_t(std::upper_bound(ends.begin(), ends.end(), point.norm()) - ends.begin());
}

}  // namespace

KeptCount& KeptCount::operator+=(const KeptCount& more) {
  before += more.before;
  kept += more.kept;
  return *this;
}

double FeatureCounts::false_ratio() const {
  return ratio(false_edges + false_planes, edges + planes);
}

FeatureCounts& FeatureCounts::operator+=(const FeatureCounts& more) {
  edges += more.edges;
  false_edges += more.false_edges;
  off_edge += more.off_edge;
  planes += more.planes;
  false_planes += more.false_planes;
  return *this;
}

KeptCount FilterScore::false_points() const {
  KeptCount all = of(PointKind::outlier);
  all += of(PointKind::mixed);
  return all += of(PointKind::ghost);
}

double FilterScore::accuracy() const {
  KeptCount truth = of(PointKind::surface);
  truth += of(PointKind::moving);
  const KeptCount wrong = false_points();
  return ratio(truth.kept + wrong.before - wrong.kept, truth.before + wrong.before);
}

double FilterScore::precision() const {
  const KeptCount wrong = false_points();
  std::size_t removed = 0;
  for (const KeptCount& count : kinds) removed += count.before - count.kept;
  return ratio(wrong.before - wrong.kept, removed);
}

double FilterScore::pseudo_reduction() const {
  return features_before.false_edges == 0
             ? 0.0
             : 1.0 - double(features_after.false_edges) / double(features_before.false_edges);
}

FilterScore& FilterScore::operator+=(const FilterScore& more) {
  scans += more.scans;
  for (std::size_t i = 0; i < kinds.size(); ++i) kinds[i] += more.kinds[i];
  obvious += more.obvious;
  edges += more.edges;
  for (std::size_t i = 0; i < surface_by_range.size(); ++i) surface_by_range[i] += more.surface_by_range[i];
  features_before += more.features_before;
  features_after += more.features_after;
  return *this;
}

std::vector<std::uint8_t> mark_obvious(const PointCloud& cloud, std::span<const std::uint8_t> labels) {
  check_length("labels", labels.size(), cloud.size());
  std::vector<std::uint8_t> obvious(cloud.size(), 0);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (!is_false(labels[i]) || kind_of(labels[i]) == PointKind::ghost) continue;
    bool clear = true;
    for (std::size_t j = 0; j < cloud.size() && clear; ++j) {
      const bool near = (cloud.points[j] - cloud.points[i]).squaredNorm() < kObviousClearance * kObviousClearance;
      clear = !near || kind_of(labels[j]) != PointKind::surface;
    }
    obvious[i] = clear;
  }
  return obvious;
}

FilterScore score_filter(const LabelledCloud& scan, std::span<const std::uint8_t> keep) {
  check_length("labels", scan.labels.size(), scan.cloud.size());
  check_length("keep", keep.size(), scan.cloud.size());
  FilterScore score;
  score.scans = 1;
  for (std::size_t i = 0; i < keep.size(); ++i) {
    const KeptCount one{1, std::size_t(keep[i] != 0)};
    const PointKind kind = kind_of(scan.labels[i]);
    if (std::size_t(kind) >= score.kinds.size()) {
      throw Error("labels", "entry " + std::to_string(i) + " is " + std::to_string(scan.labels[i]) + ", no known kind");
    }
    score.kinds[std::size_t(kind)] += one;
    if (!scan.obvious.empty() && scan.obvious[i]) score.obvious += one;
    if (kind != PointKind::surface) continue;
    if (is_on_edge(scan.labels[i])) score.edges += one;
    score.surface_by_range[range_of(scan.cloud.points[i])] += one;
  }
  return score;
}

FeatureCounts count_features(std::span<const std::uint8_t> labels, std::span<const std::uint32_t> edges,
                             std::span<const std::uint32_t> planes) {
  FeatureCounts counts;
  counts.edges = edges.size();
  counts.planes = planes.size();
  for (const std::uint32_t i : edges) {
    counts.false_edges += is_false(labels[i]);
    counts.off_edge += !is_false(labels[i]) && !is_on_edge(labels[i]);
  }
  for (const std::uint32_t i : planes) counts.false_planes += is_false(labels[i]);
  return counts;
}

}  // namespace tilth
