#include <algorithm>

#include <tilth/features/floam_features.hpp>

namespace tilth {
namespace {

using Indices = std::vector<std::uint32_t>;

constexpr std::size_t kSectors = 6;

// The points of each ring in the order of their firing.
std::vector<Indices> rings_of(const PointCloud& cloud) {
  std::vector<Indices> rings(1);
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    const std::size_t ring = cloud.has_rings() ? cloud.rings[i] : 0;
    if (ring >= rings.size()) rings.resize(ring + 1);
    rings[ring].push_back(i);
  }
  return rings;
}

// Chooses the features of one ring, sector by sector.
class RingFeatures {
 public:
  RingFeatures(const std::vector<Eigen::Vector3d>& ring, std::vector<double> curvature,
               const FloamFeatureOptions& options)
      : ring_(ring), options_(options), curvature_(std::move(curvature)), ruled_out_(ring.size(), 0) {}

  /// Appends the numbers of the points, in the ring, to `edges` and `planes`.
  void choose(Indices& edges, Indices& planes) {
    const std::size_t first = kCurvatureMargin, last = ring_.size() - kCurvatureMargin;
    const std::size_t length = (last - first) / kSectors;
    for (std::size_t s = 0; s < kSectors; ++s) {
      const std::size_t begin = first + s * length, whole = s + 1 == kSectors ? last : begin + length;
      const std::size_t end = whole - (options_.skip_sector_ends ? 1 : 0);
      choose_edges(begin, end, edges);
      choose_planes(begin, end, planes);
    }
  }

 private:
  // From the most curved point down. A sector knows nothing of what the one before it has ruled out.
  void choose_edges(std::size_t begin, std::size_t end, Indices& edges) {
    Indices order;
    for (std::size_t i = begin; i < end; ++i) {
      if (curvature_[i] > options_.edge_threshold) order.push_back(std::uint32_t(i));
    }
    sort_by(-1, order);
    std::fill(ruled_out_.begin(), ruled_out_.end(), std::uint8_t{0});
    int count = 0;
    for (const std::uint32_t i : order) {
      if (count == options_.edges) break;
      if (ruled_out_[i]) continue;
      ++count;
      edges.push_back(i);
      rule_out_around(i);
    }
  }

  // What is neither edge nor beside one: all of it, or the least curved points in the order of firing.
  void choose_planes(std::size_t begin, std::size_t end, Indices& planes) const {
    Indices left;
    for (std::size_t i = begin; i < end; ++i) {
      if (!ruled_out_[i]) left.push_back(std::uint32_t(i));
    }
    if (options_.planes > 0 && left.size() > std::size_t(options_.planes)) {
      sort_by(1, left);
      left.resize(std::size_t(options_.planes));
      std::sort(left.begin(), left.end());
    }
    planes.insert(planes.end(), left.begin(), left.end());
  }

  // By `sign` times the curvature, equal ones in the order of firing.
  void sort_by(double sign, Indices& points) const {
    std::sort(points.begin(), points.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(sign * curvature_[a], a) < std::pair(sign * curvature_[b], b);
    });
  }

  void rule_out_around(std::size_t i) {
    ruled_out_[i] = 1;
    for (std::size_t k = i; k < i + kCurvatureMargin && !is_gap(k, k + 1); ++k) ruled_out_[k + 1] = 1;
    for (std::size_t k = i; k + kCurvatureMargin > i && !is_gap(k, k - 1); --k) ruled_out_[k - 1] = 1;
  }

  bool is_gap(std::size_t a, std::size_t b) const {
    return (ring_[a] - ring_[b]).squaredNorm() > options_.max_gap * options_.max_gap;
  }

  const std::vector<Eigen::Vector3d>& ring_;
  const FloamFeatureOptions& options_;
  std::vector<double> curvature_;
  std::vector<std::uint8_t> ruled_out_;
};

// Features of all rings; curvature_of(ring, its points) gives a value for each of them.
template <class CurvatureOf>
FeatureIndices choose(const PointCloud& cloud, const FloamFeatureOptions& options, const CurvatureOf& curvature_of) {
  FeatureIndices features;
  for (const Indices& ring : rings_of(cloud)) {
    if (ring.size() < std::size_t(options.min_ring_points)) continue;
    Indices edges, planes;
    const PointCloud points = select(cloud, ring);
    RingFeatures(points.points, curvature_of(ring, points.points), options).choose(edges, planes);
    for (const std::uint32_t i : edges) features.edges.push_back(ring[i]);
    for (const std::uint32_t i : planes) features.planes.push_back(ring[i]);
  }
  return features;
}

}  // namespace

FeatureIndices choose_floam_features(const PointCloud& cloud, std::span<const double> curvature,
                                     const FloamFeatureOptions& options) {
  return choose(cloud, options, [&](const Indices& ring, const auto&) {
    std::vector<double> of_ring;
    of_ring.reserve(ring.size());
    for (const std::uint32_t i : ring) of_ring.push_back(curvature[i]);
    return of_ring;
  });
}

FeatureClouds floam_features(const PointCloud& cloud, const FloamFeatureOptions& options) {
  const FeatureIndices chosen =
      choose(cloud, options, [&](const Indices&, const auto& points) { return curvature(points, options.curvature); });
  return {select(cloud, chosen.edges), select(cloud, chosen.planes)};
}

}  // namespace tilth
