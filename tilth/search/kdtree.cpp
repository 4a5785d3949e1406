#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include <nanoflann.hpp>

#include <tilth/search/kdtree.hpp>

namespace tilth {
namespace {

using Point = std::array<float, 3>;

constexpr std::size_t kLeafPoints = 16;
// Negative: branches are cut a little late, so that rounding in the sums of nanoflann's bounds never costs a neighbour.
constexpr float kLateCut = -1e-4f;

Point to_float(const Eigen::Vector3d& p) {
  return {float(p.x()), float(p.y()), float(p.z())};
}

struct Points {
  std::vector<Point> points;

  std::size_t kdtree_get_point_count() const { return points.size(); }
  float kdtree_get_pt(std::size_t i, std::size_t axis) const { return points[i][axis]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

/// Result set of nanoflann: the k nearest, kept sorted by insertion.
struct Nearest {
  using DistanceType = float;
  std::vector<Neighbor>& out;
  std::size_t k;

  std::size_t size() const { return out.size(); }
  bool full() const { return out.size() == k; }
  float worstDist() const { return full() ? float(out.back().squared_distance) : std::numeric_limits<float>::max(); }
  bool addPoint(float squared_distance, std::uint32_t index) {
    if (full() && !(squared_distance < worstDist())) return true;
    if (full()) out.pop_back();
    const auto farther = [](double d, const Neighbor& n) { return d < n.squared_distance; };
    out.insert(std::upper_bound(out.begin(), out.end(), squared_distance, farther), {index, squared_distance});
    return true;
  }
};

}  // namespace

struct KdTree::Tree {
  using Index =
      nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Points>, Points, 3, std::uint32_t>;

  explicit Tree(std::vector<Point> p) : points{std::move(p)}, index(3, points, kLeafPoints) {
    if (!points.points.empty()) index.buildIndex();
  }
  Points points;
  Index index;
};

KdTree::KdTree(std::span<const Eigen::Vector3d> points) {
  std::vector<Point> rounded(points.size());
  std::transform(points.begin(), points.end(), rounded.begin(), to_float);
  tree_ = std::make_unique<Tree>(std::move(rounded));
}
KdTree::KdTree(KdTree&&) noexcept = default;
KdTree& KdTree::operator=(KdTree&&) noexcept = default;
KdTree::~KdTree() = default;

std::size_t KdTree::size() const {
  return tree_->points.points.size();
}

void KdTree::knn(const Eigen::Vector3d& query, std::size_t k, std::vector<Neighbor>& out) const {
  out.clear();
  if (k == 0 || size() == 0) return;
  out.reserve(k);
  Nearest nearest{out, k};
  tree_->index.findNeighbors(nearest, to_float(query).data(), nanoflann::SearchParams(0, kLateCut));
}

std::optional<Neighbor> KdTree::nearest(const Eigen::Vector3d& query) const {
  if (size() == 0) return std::nullopt;
  nanoflann::KNNResultSet<float, std::uint32_t> nearest(1);
  Neighbor found;
  float squared_distance = 0;
  nearest.init(&found.index, &squared_distance);
  tree_->index.findNeighbors(nearest, to_float(query).data(), nanoflann::SearchParams(0, kLateCut));
  found.squared_distance = squared_distance;
  return found;
}

}  // namespace tilth
