// Pieces of rings in a cloud whose sensor stands nobody knows where: points that one beam has met one after another. In
// the order of firing or of storage, the next point of a beam is the nearest in direction among those that follow soon;
// without an order, a beam's own points are nearer than those of others. O(n log n).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace tilth {

/// Sets of points, each on one ring, one set after another.
struct RingArcs {
  std::vector<Eigen::Vector3d> points;     ///< [m] in the frame of the cloud
  std::vector<std::uint32_t> begin = {0};  ///< sets + 1

  std::size_t size() const { return begin.size() - 1; }
  std::span<const Eigen::Vector3d> arc(std::size_t i) const {
    return std::span(points).subspan(begin[i], begin[i + 1] - begin[i]);
  }
  void add(std::span<const Eigen::Vector3d> arc) {
    points.insert(points.end(), arc.begin(), arc.end());
    begin.push_back(std::uint32_t(points.size()));
  }
};

/// About `most` arcs at most, that follow the order of the points of a scan. The next point of a beam is looked for
/// `first_after` places after the last and later: nearer ones are of other beams.
void add_arcs_in_order(std::span<const Eigen::Vector3d> points, std::size_t first_after, std::size_t most,
                       RingArcs& arcs);

/// The same from nearest neighbours, whatever the order.
void add_arcs_of_neighbors(std::span<const Eigen::Vector3d> points, std::size_t most, RingArcs& arcs);

}  // namespace tilth
