// A kd-tree over the points of a cloud, built by nanoflann (Blanco and Rai) on coordinates rounded to float.
// Building costs O(n log n), a query O(log n) on average.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <tilth/search/nearest_neighbors.hpp>

namespace tilth {

class KdTree {
 public:
  /// Keeps its own copy of `points` [m], which must be finite.
  explicit KdTree(std::span<const Eigen::Vector3d> points);
  KdTree(KdTree&&) noexcept;
  KdTree& operator=(KdTree&&) noexcept;
  ~KdTree();

  std::size_t size() const;

  /// The min(k, size()) nearest points to `query`, nearest first. Squared distances are those of float coordinates,
  /// (dx dx + dy dy) + dz dz in float, as scan_neighbors() gives them.
  void knn(const Eigen::Vector3d& query, std::size_t k, std::vector<Neighbor>& out) const;

  /// The nearest point, or nothing where there are no points.
  std::optional<Neighbor> nearest(const Eigen::Vector3d& query) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

static_assert(NearestNeighbors<KdTree>);

}  // namespace tilth
