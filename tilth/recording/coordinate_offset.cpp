#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Cholesky>

#include <tilth/recording/coordinate_offset.hpp>

namespace tilth {
namespace {

constexpr double kFarInSpreads = 10.0, kFarInUnits = 500.0;
constexpr std::uint16_t kMostRings = 128;
constexpr int kSteps = 40;
constexpr double kStill = 1e-7;                           ///< [m] a step as small ends the search
constexpr double kOnCones = 0.03;                         ///< [m] rms of the points from their cones
constexpr double kNearAxis = 0.2;                         ///< [m] nearer, a point tells nothing
constexpr std::array<double, 3> kStarts{0.0, -0.3, 0.3};  ///< spreads of the points from their middle

struct Extent {
  Eigen::Vector3d middle, width;  ///< medians, and from the 10th percentile to the 90th
};

Extent spread_of(std::span<const Eigen::Vector3d> points) {
  Extent spread;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const Eigen::Vector3d& p : points) values.push_back(p[axis]);
    std::sort(values.begin(), values.end());
    spread.middle[axis] = values[values.size() / 2];
    spread.width[axis] = values[values.size() * 9 / 10] - values[values.size() / 10];
  }
  return spread;
}

/// An apex, the slopes of the cones about it, and how far the points are from them.
struct Cones {
  Eigen::Vector3d apex;
  Eigen::VectorXd slopes;
  double rms = 0.0;
};

/// The normal equations of z - z0 = slope * distance from the axis, over apex and slopes.
struct Equations {
  Eigen::MatrixXd H;
  Eigen::VectorXd b;
  double squares = 0.0;
};

Equations linearised(std::span<const Eigen::Vector3d> points, std::span<const std::uint16_t> rings,
                     const Cones& cones) {
  const Eigen::Index n = 3 + cones.slopes.size();
  Equations e{Eigen::MatrixXd::Zero(n, n), Eigen::VectorXd::Zero(n), 0.0};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d d = points[i] - cones.apex;
    const double rho = std::max(d.head<2>().norm(), kNearAxis), slope = cones.slopes[rings[i]];
    const Eigen::Index ring = 3 + rings[i];
    const std::array<Eigen::Index, 4> at{0, 1, 2, ring};
    const std::array<double, 4> J{slope * d.x() / rho, slope * d.y() / rho, -1.0, -rho};
    const double residual = d.z() - slope * rho;
    e.squares += residual * residual;
    for (std::size_t r = 0; r < 4; ++r) {
      e.b[at[r]] += J[r] * residual;
      for (std::size_t c = 0; c < 4; ++c) e.H(at[r], at[c]) += J[r] * J[c];
    }
  }
  return e;
}

void add_slopes(std::span<const Eigen::Vector3d> points, std::span<const std::uint16_t> rings, Cones& cones) {
  Eigen::VectorXd rise = Eigen::VectorXd::Zero(cones.slopes.size()), square = rise;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d d = points[i] - cones.apex;
    rise[rings[i]] += d.z() * d.head<2>().norm();
    square[rings[i]] += d.head<2>().squaredNorm();
  }
  for (Eigen::Index r = 0; r < rise.size(); ++r) cones.slopes[r] = square[r] > 0.0 ? rise[r] / square[r] : 0.0;
}

/// Levenberg-Marquardt from `apex`.
Cones fitted(std::span<const Eigen::Vector3d> points, std::span<const std::uint16_t> rings,
             const Eigen::Vector3d& apex) {
  Cones best{apex, Eigen::VectorXd::Zero(*std::max_element(rings.begin(), rings.end()) + 1), 0.0};
  add_slopes(points, rings, best);
  Equations e = linearised(points, rings, best);
  double damping = 1e-3;
  for (int step = 0; step < kSteps && damping < 1e9; ++step) {
    Eigen::MatrixXd H = e.H;
    H.diagonal() += damping * e.H.diagonal() + Eigen::VectorXd::Constant(H.rows(), 1e-9);
    const Eigen::VectorXd change = -H.ldlt().solve(e.b);
    Cones next{best.apex + change.head<3>(), best.slopes + change.tail(best.slopes.size()), 0.0};
    Equations after = linearised(points, rings, next);
    const bool better = after.squares < e.squares;
    damping *= better ? 0.2 : 10.0;
    if (!better) continue;
    best = std::move(next);
    e = std::move(after);
    if (change.head<3>().norm() < kStill) break;
  }
  best.rms = std::sqrt(e.squares / double(points.size()));
  return best;
}

}  // namespace

std::optional<Eigen::Vector3d> far_offset(std::span<const Eigen::Vector3d> points) {
  if (points.empty()) return std::nullopt;
  const Extent spread = spread_of(points);
  const double far = spread.middle.cwiseAbs().maxCoeff();
  if (far < kFarInUnits || far < kFarInSpreads * spread.width.maxCoeff()) return std::nullopt;
  return spread.middle;
}

std::optional<Eigen::Vector3d> apex_of_rings(std::span<const Eigen::Vector3d> points,
                                             std::span<const std::uint16_t> rings) {
  if (points.empty() || *std::max_element(rings.begin(), rings.end()) >= kMostRings) return std::nullopt;
  const Extent spread = spread_of(points);
  std::optional<Cones> best;
  for (const double x : kStarts) {
    for (const double y : kStarts) {
      const Eigen::Vector3d start = spread.middle + Eigen::Vector3d(x * spread.width.x(), y * spread.width.y(), 0.0);
      Cones cones = fitted(points, rings, start);
      if (!best || cones.rms < best->rms) best = std::move(cones);
    }
  }
  return best->rms < kOnCones ? std::optional(best->apex) : std::nullopt;
}

}  // namespace tilth
