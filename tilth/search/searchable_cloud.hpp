// Points and the kd-tree over them: for whoever needs the neighbours themselves and not only their numbers.
#pragma once

#include <utility>

#include <tilth/search/kdtree.hpp>

namespace tilth {

class SearchableCloud {
 public:
  /// `points` [m] must be finite. O(n log n).
  explicit SearchableCloud(std::vector<Eigen::Vector3d> points) : points_(std::move(points)), tree_(points_) {}

  void knn(const Eigen::Vector3d& query, std::size_t k, std::vector<Neighbor>& out) const { tree_.knn(query, k, out); }
  std::optional<Neighbor> nearest(const Eigen::Vector3d& query) const { return tree_.nearest(query); }
  std::size_t size() const { return points_.size(); }
  std::span<const Eigen::Vector3d> points() const { return points_; }

 private:
  std::vector<Eigen::Vector3d> points_;
  KdTree tree_;
};

static_assert(NearestNeighbors<SearchableCloud>);

}  // namespace tilth
