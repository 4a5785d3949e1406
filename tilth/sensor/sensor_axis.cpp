#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>

#include <tilth/core/evenly_chosen.hpp>
#include <tilth/core/median.hpp>
#include <tilth/core/turn.hpp>
#include <tilth/sensor/sensor_axis.hpp>

namespace tilth {
namespace {

using Vector5d = Eigen::Matrix<double, 5, 1>;
using Matrix5d = Eigen::Matrix<double, 5, 5>;

constexpr double kLeastSigma = 1e-5;  // [rad]
constexpr double kFarthest = 4.0;     // [m] of the origin from that of the cloud
constexpr double kMostStep = 0.5;     // [m] of the origin, or as much of the axis [rad]
constexpr double kEnough = 1e-9;      // [m, rad] a step that is the last one

/// Two directions across the axis: in which it can turn.
struct Across {
  Eigen::Vector3d first, second;
  explicit Across(const Eigen::Vector3d& axis) : first(axis.unitOrthogonal()), second(axis.cross(first)) {}
};

/// The normal equations of one arc, in units of the arc's own width: residuals are angles between arc and ring.
struct ArcSystem {
  Matrix5d H = Matrix5d::Zero();
  Vector5d b = Vector5d::Zero();
  double error = 0.0;  // [rad] root mean square

  ArcSystem(std::span<const Eigen::Vector3d> arc, const SensorAxis& at, const Across& across) {
    Vector5d mean_J = Vector5d::Zero();
    Eigen::Vector3d mean_d = Eigen::Vector3d::Zero();
    double mean_q = 0, squares = 0;
    for (const Eigen::Vector3d& p : arc) {
      const Eigen::Vector3d offset = p - at.origin;
      const double range = std::max(offset.norm(), 0.05);
      const Eigen::Vector3d d = offset / range;
      const double q = d.dot(at.axis);
      Vector5d J;
      J << d.dot(across.first), d.dot(across.second), -(at.axis - q * d) / range;
      H += J * J.transpose(), b += J * q, squares += q * q;
      mean_J += J, mean_q += q, mean_d += d;
    }
    const auto n = double(arc.size());
    mean_J /= n, mean_q /= n, mean_d /= n;
    const double width = n * std::max(1 - mean_d.squaredNorm(), 1e-12);
    H = (H - n * mean_J * mean_J.transpose()) / width;
    b = (b - n * mean_J * mean_q) / width;
    error = std::sqrt(std::max(0.0, squares - n * mean_q * mean_q) / width);
  }
};

std::vector<double> errors(const RingArcs& arcs, const SensorAxis& at) {
  const Across across(at.axis);
  std::vector<double> errors;
  errors.reserve(arcs.size());
  for (std::size_t i = 0; i < arcs.size(); ++i) errors.push_back(ArcSystem(arcs.arc(i), at, across).error);
  return errors;
}

/// One step; its size.
double step(const RingArcs& arcs, SensorAxis& at) {
  const Across across(at.axis);
  std::vector<ArcSystem> systems;
  std::vector<double> error;
  systems.reserve(arcs.size());
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    systems.emplace_back(arcs.arc(i), at, across);
    error.push_back(systems.back().error);
  }
  const double sigma = std::max(2 * median(error), kLeastSigma);
  Matrix5d H = Matrix5d::Zero();
  Vector5d b = Vector5d::Zero();
  for (const ArcSystem& system : systems) {
    const double ratio = system.error / sigma, weight = 1 / ((1 + ratio * ratio) * (1 + ratio * ratio));
    H += weight * system.H, b += weight * system.b;
  }
  H.diagonal() += 1e-6 * H.diagonal() + Vector5d::Constant(1e-12);
  Vector5d x = -H.ldlt().solve(b);
  const double size = x.norm();
  if (size > kMostStep) x *= kMostStep / size;
  at.axis = (at.axis + x[0] * across.first + x[1] * across.second).normalized();
  at.origin += x.tail<3>();
  return size;
}

/// Every `stride`-th arc.
RingArcs thinned(const RingArcs& arcs, std::size_t most) {
  RingArcs some;
  const std::size_t stride = stride_of(arcs.size(), most);
  for (std::size_t i = 0; i < arcs.size(); i += stride) some.add(arcs.arc(i));
  return some;
}

std::vector<SensorAxis> starts() {
  std::vector<SensorAxis> starts;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = 0; z <= 1; ++z) {
        const bool other_half = z == 0 && (y < 0 || (y == 0 && x <= 0));
        if (other_half) continue;
        const Eigen::Vector3d axis = Eigen::Vector3d(x, y, z).normalized();
        for (const double height : {0.0, 1.2, -1.2}) starts.push_back({height * Eigen::Vector3d::UnitZ(), axis});
      }
    }
  }
  return starts;
}

/// Upwards; where it lies flat, along the axis of the cloud that it is nearest to.
Eigen::Vector3d turned_up(const Eigen::Vector3d& axis) {
  constexpr double kFlat = 0.05;
  Eigen::Index most = 2;
  if (std::abs(axis.z()) < kFlat) axis.cwiseAbs().maxCoeff(&most);
  return axis[most] < 0 ? Eigen::Vector3d(-axis) : axis;
}

}  // namespace

Eigen::Isometry3d SensorAxis::T_cloud_sensor() const {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = least_turn(Eigen::Vector3d::UnitZ(), axis);
  T.translation() = origin;
  return T;
}

SensorAxis fit_axis(const RingArcs& arcs, const SensorAxis& start, int steps) {
  SensorAxis at = start;
  if (arcs.size() == 0) return at;
  for (int i = 0; i < steps; ++i) {
    if (step(arcs, at) < kEnough) break;
  }
  at.axis = turned_up(at.axis);
  at.error = median(errors(arcs, at));
  return at;
}

SensorAxis search_axis(const RingArcs& arcs) {
  constexpr std::size_t kFew = 300;
  constexpr int kFewSteps = 12, kSteps = 30;
  SensorAxis best;
  best.error = std::numeric_limits<double>::infinity();
  const RingArcs some = thinned(arcs, kFew);
  if (some.size() == 0) return best;
  for (const SensorAxis& start : starts()) {
    const SensorAxis found = fit_axis(some, start, kFewSteps);
    if (found.origin.norm() < kFarthest && found.error < best.error) best = found;
  }
  SensorAxis fitted = fit_axis(arcs, best, kSteps);
  if (!(fitted.origin.norm() < kFarthest)) fitted.error = std::numeric_limits<double>::infinity();
  return fitted;
}

}  // namespace tilth
