#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/LU>
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

/// The least x with A^T A x = h: closed where the columns of A span as many dimensions as they are, else by QR.
template <int kColumns>
Eigen::Vector3d center_in_hull(const Eigen::Matrix<double, 3, kColumns>& A) {
  using Square = Eigen::Matrix<double, kColumns, kColumns>;
  const Square gram = A.transpose() * A;
  const Eigen::Matrix<double, kColumns, 1> half = 0.5 * gram.diagonal();
  Square inverse;
  bool is_regular = false;
  gram.computeInverseWithCheck(inverse, is_regular, 1e-10 * gram.diagonal().prod());
  return A * (is_regular ? (inverse * half).eval() : gram.colPivHouseholderQr().solve(half).eval());
}

/// The smallest ball through all points of the support: its center c lies in their hull, c = p_0 + A x, and is as far
/// from p_0 as from each p_j, 2 A^T A x = diag(A^T A).
BoundingBall through(const BallSupport& support) {
  if (support.count == 0) return {};
  const Eigen::Vector3d origin = support.points.col(0);
  const Eigen::Matrix3d sides = support.points.rightCols<3>().colwise() - origin;
  Eigen::Vector3d to_center = Eigen::Vector3d::Zero();
  if (support.count == 2) to_center = 0.5 * sides.col(0);
  if (support.count == 3) to_center = center_in_hull<2>(sides.leftCols<2>());
  if (support.count == 4) to_center = center_in_hull<3>(sides);
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
      const std::span<const std::uint32_t> row = neighbors.neighbors(i);
      for (auto n = row.rbegin(); n != row.rend(); ++n) around.push_back(cloud.points[*n]);  // the farthest bound it
      const double unit = scale.empty() ? 1.0 : double(scale[i]);
      const double radius = std::max(unit * std::sqrt(bounding_ball(std::move(around)).squared_radius), kLeastRadius);
      rho[i] = float(double(neighbors.k) / (4.0 / 3.0 * std::numbers::pi * radius * radius * radius));
    }
  });
}

}  // namespace tilth
