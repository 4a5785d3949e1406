#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Eigenvalues>

#include <tilth/core/evenly_chosen.hpp>
#include <tilth/search/kdtree.hpp>
#include <tilth/sensor/ring_arcs.hpp>

namespace tilth {
namespace {

constexpr std::size_t kArcPoints = 12;   // of an arc in order
constexpr std::size_t kNeighbors = 7;    // of a seed, with it an arc without order
constexpr std::size_t kLastAfter = 320;  // places after a point within which its beam fires again
constexpr double kLongestStep = 0.03;    // [rad] from a point of an arc to the next
constexpr double kDepthStep = 0.05;      // [-] of the range
constexpr double kThin = 0.02;           // [-] variance across an arc over that along it
constexpr double kTooNear = 0.3;         // [m]

std::vector<Eigen::Vector3d> directions(std::span<const Eigen::Vector3d> points) {
  std::vector<Eigen::Vector3d> directions;
  directions.reserve(points.size());
  for (const Eigen::Vector3d& p : points) directions.push_back(p / std::max(p.norm(), kTooNear));
  return directions;
}

/// The points of a scan in their order, of which each beam's follow one another after some places.
struct OrderedScan {
  std::span<const Eigen::Vector3d> points;
  std::vector<Eigen::Vector3d> directions;
  std::size_t first_after;

  /// The next point of the beam of point `at`; 0 where it is lost.
  std::size_t next(std::size_t at) const {
    std::size_t next = 0;
    double least = kLongestStep * kLongestStep;
    for (std::size_t i = at + first_after; i < std::min(points.size(), at + kLastAfter); ++i) {
      const double squared = (directions[i] - directions[at]).squaredNorm();
      if (squared < least) least = squared, next = i;
    }
    const bool near = std::abs(points[next].norm() - points[at].norm()) <= kDepthStep * points[at].norm();
    return near ? next : 0;
  }

  /// The arc from point `first` on; false where the beam is lost.
  bool follow(std::size_t first, std::vector<Eigen::Vector3d>& arc) const {
    arc.assign(1, points[first]);
    for (std::size_t at = next(first); at != 0; at = next(at)) {
      arc.push_back(points[at]);
      if (arc.size() == kArcPoints) return true;
    }
    return false;
  }
};

/// Whether directions are those of a line.
bool is_thin(std::span<const Eigen::Vector3d> directions) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& d : directions) mean += d / double(directions.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& d : directions) scatter += (d - mean) * (d - mean).transpose();
  const Eigen::Vector3d values =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter, Eigen::EigenvaluesOnly).eigenvalues();
  return values[1] < kThin * values[2];
}

}  // namespace

void add_arcs_in_order(std::span<const Eigen::Vector3d> points, std::size_t first_after, std::size_t most,
                       RingArcs& arcs) {
  const OrderedScan scan{points, directions(points), first_after};
  const std::size_t stride = stride_of(points.size(), most);
  std::vector<Eigen::Vector3d> arc;
  for (std::size_t i = 0; i < points.size(); i += stride) {
    if (points[i].norm() > kTooNear && scan.follow(i, arc)) arcs.add(arc);
  }
}

void add_arcs_of_neighbors(std::span<const Eigen::Vector3d> points, std::size_t most, RingArcs& arcs) {
  const std::vector<Eigen::Vector3d> seen = directions(points);
  const KdTree tree(seen);
  const std::size_t stride = stride_of(points.size(), most);
  std::vector<Neighbor> neighbors;
  std::vector<Eigen::Vector3d> arc, arc_directions;
  for (std::size_t i = 0; i < points.size(); i += stride) {
    tree.knn(seen[i], kNeighbors + 1, neighbors);
    arc.clear(), arc_directions.clear();
    const double range = points[i].norm();
    for (const Neighbor& n : neighbors) {
      if (std::abs(points[n.index].norm() - range) > 2 * kDepthStep * range) continue;
      arc.push_back(points[n.index]), arc_directions.push_back(seen[n.index]);
    }
    if (range > kTooNear && arc.size() > kNeighbors / 2 + 1 && is_thin(arc_directions)) arcs.add(arc);
  }
}

}  // namespace tilth
