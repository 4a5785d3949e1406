#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include <tilth/core/least_spread.hpp>

namespace tilth {
namespace {

/// x^3 - trace x^2 + minors x - determinant, a characteristic polynomial, all of whose roots are real and none
/// negative.
struct Cubic {
  double trace, minors, determinant;
};

/// Of a matrix given by its entries xx, yy, zz, xy, yz, zx.
Cubic characteristic(const Eigen::Matrix<double, 6, 1>& C) {
  const double xx = C[0], yy = C[1], zz = C[2], xy = C[3], yz = C[4], zx = C[5];
  const double m0 = yy * zz - yz * yz, m1 = xx * zz - zx * zx, m2 = xx * yy - xy * xy;
  return {xx + yy + zz, m0 + m1 + m2, xx * m0 - xy * (xy * zz - yz * zx) + zx * (xy * yz - yy * zx)};
}

// Laguerre's method ascends from 0 to the least root, in two to four steps unless all three are nearly one: what it
// moves by. 0 where no step can be made.
double laguerre_step(const Cubic& c, double x) {
  const double value = ((x - c.trace) * x + c.minors) * x - c.determinant;
  const double slope = (3 * x - 2 * c.trace) * x + c.minors, curve = 6 * x - 2 * c.trace;
  const double square = 4 * slope * slope - 6 * value * curve;
  const double divisor = slope + std::sqrt(square > 0 ? square : 0.0);
  return divisor > 0 ? -3 * value / divisor : 0.0;
}

constexpr int kMostSteps = 40;
constexpr double kStill = 1e-9;

double least_root(const Cubic& c, double x = 0) {
  for (int i = 0; i < kMostSteps; ++i) {
    const double step = laguerre_step(c, x);
    x += step;
    if (std::abs(step) <= kStill * x) break;
  }
  return x;
}

Eigen::Vector3d roots(const Cubic& c, double least) {
  const double half_sum = 0.5 * (c.trace - least), product = c.minors - 2 * least * half_sum;
  const double half_difference = std::sqrt(std::max(0.0, half_sum * half_sum - product));
  return {least, half_sum - half_difference, half_sum + half_difference};
}

constexpr std::size_t kLanes = 16;

/// least_root() of as many polynomials as there are lanes, step by step, each until its own stands still.
struct Roots {
  double trace[kLanes] = {}, minors[kLanes] = {}, determinant[kLanes] = {}, x[kLanes] = {}, open[kLanes];

  void find() {
    constexpr int kTogether = 4;  // after which those that have not settled go on alone
    std::fill(open, open + kLanes, 1.0);
    for (int i = 0; i < kTogether; ++i) step();
    for (std::size_t i = 0; i < kLanes; ++i) {
      if (open[i] != 0) x[i] = least_root({trace[i], minors[i], determinant[i]}, x[i]);
    }
  }

  // With 16 lanes, and no fewer, compilers make vectors of this loop.
  void step() {
    for (std::size_t i = 0; i < kLanes; ++i) {
      const double step = open[i] * laguerre_step({trace[i], minors[i], determinant[i]}, x[i]);
      x[i] += step;
      open[i] = std::abs(step) <= kStill * x[i] ? 0.0 : open[i];
    }
  }
};

}  // namespace

Eigen::Vector3d spreads(const Eigen::Matrix3d& C) {
  Eigen::Matrix<double, 6, 1> entries;
  entries << C(0, 0), C(1, 1), C(2, 2), C(0, 1), C(1, 2), C(0, 2);
  const Cubic c = characteristic(entries);
  return roots(c, least_root(c));
}

void spreads(std::span<const Eigen::Matrix<double, 6, 1>> covariances, std::span<Eigen::Vector3d> eigenvalues) {
  for (std::size_t begin = 0; begin < covariances.size(); begin += kLanes) {
    const std::size_t count = std::min(kLanes, covariances.size() - begin);
    Roots lanes;
    for (std::size_t i = 0; i < count; ++i) {
      const Cubic c = characteristic(covariances[begin + i]);
      lanes.trace[i] = c.trace;
      lanes.minors[i] = c.minors;
      lanes.determinant[i] = c.determinant;
    }
    lanes.find();
    for (std::size_t i = 0; i < count; ++i)
      eigenvalues[begin + i] = roots({lanes.trace[i], lanes.minors[i], lanes.determinant[i]}, lanes.x[i]);
  }
}

Eigen::Vector3d direction_of_least(const Eigen::Matrix3d& covariance, double least) {
  const Eigen::Matrix3d shifted = covariance - least * Eigen::Matrix3d::Identity();
  // It is normal to every row; the two that are least parallel tell best.
  const Eigen::Vector3d normals[] = {shifted.col(0).cross(shifted.col(1)), shifted.col(1).cross(shifted.col(2)),
                                     shifted.col(2).cross(shifted.col(0))};
  const double squares[] = {normals[0].squaredNorm(), normals[1].squaredNorm(), normals[2].squaredNorm()};
  const auto longest = std::max_element(squares, squares + 3) - squares;
  const double square = covariance.trace() * covariance.trace();
  if (squares[longest] > 1e-24 * square * square) return normals[longest] / std::sqrt(squares[longest]);
  Eigen::Index most;  // it is nearly a line, or a ball
  covariance.diagonal().maxCoeff(&most);
  const Eigen::Vector3d along = shifted.col(most);
  return along.squaredNorm() > 0 ? along.unitOrthogonal() : Eigen::Vector3d::UnitZ();
}

}  // namespace tilth
