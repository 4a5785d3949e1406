#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/QR>

#include <tilth/core/parallel.hpp>
#include <tilth/preprocess/bounding_ball.hpp>

namespace tilth {
namespace {

constexpr double kSlack = 1e-9;  // share of the squared radius by which a point may lie outside

/// At most four points on the boundary.
struct BallSupport {
  Eigen::Matrix<double, 3, 4> points = Eigen::Matrix<double, 3, 4>::Zero();
  int count = 0;

  BallSupport with(const Eigen::Vector3d& p) const {
    BallSupport more = *this;
    more.points.col(more.count++) = p;
    return more;
  }
};

bool holds(const BoundingBall& ball, const Eigen::Vector3d& p) {
  return (p - ball.center).squaredNorm() <= ball.squared_radius * (1 + kSlack);
}

/// The smallest ball through all points of the support: its center c lies in their hull, c = p_0 + A x, and is as far
/// from p_0 as from each p_j, 2 A^T A x = diag(A^T A).
BoundingBall through(const BallSupport& support) {
  if (support.count == 0) return {};
  const Eigen::Vector3d origin = support.points.col(0);
  if (support.count == 1) return {origin, 0.0};
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> A(3, support.count - 1);
  for (int j = 1; j < support.count; ++j) A.col(j - 1) = support.points.col(j) - origin;
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3> gram = A.transpose() * A;
  const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1> half = 0.5 * gram.diagonal();
  const Eigen::Vector3d to_center = A * gram.colPivHouseholderQr().solve(half);
  return {origin + to_center, to_center.squaredNorm()};
}

/// Of the first `count` points, with the support on its boundary. Points found outside are moved to the front.
BoundingBall smallest(std::vector<Eigen::Vector3d>& points, std::size_t count, const BallSupport& support) {
  BoundingBall ball = through(support);
  if (support.count == 4) return ball;
  for (std::size_t i = 0; i < count; ++i) {
    if (holds(ball, points[i])) continue;
    ball = smallest(points, i, support.with(points[i]));
    std::rotate(points.begin(), points.begin() + std::ptrdiff_t(i), points.begin() + std::ptrdiff_t(i) + 1);
  }
  return ball;
}

}  // namespace

BoundingBall bounding_ball(std::vector<Eigen::Vector3d> points) {
  return smallest(points, points.size(), {});
}

void bounding_ball_densities(const PointCloud& cloud, const NeighborTable& neighbors, std::span<const float> scale,
                             std::span<float> rho) {
  constexpr std::size_t kChunk = 256;
  constexpr double kLeastRadius = 1e-6;
  parallel_for(neighbors.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      std::vector<Eigen::Vector3d> around;
      around.reserve(neighbors.k);
      for (const std::uint32_t n : neighbors.neighbors(i)) around.push_back(cloud.points[n]);
      const double unit = scale.empty() ? 1.0 : double(scale[i]);
      const double radius = std::max(unit * std::sqrt(bounding_ball(std::move(around)).squared_radius), kLeastRadius);
      rho[i] = float(double(neighbors.k) / (4.0 / 3.0 * std::numbers::pi * radius * radius * radius));
    }
  });
}

}  // namespace tilth
