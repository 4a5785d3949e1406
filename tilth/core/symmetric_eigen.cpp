#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include <tilth/core/symmetric_eigen.hpp>

namespace tilth {
namespace {

/// x^3 - trace x^2 + minors x - determinant, a characteristic polynomial, all of whose roots are real and none
/// negative.
struct Cubic {
  double trace, minors, determinant;
};

Cubic characteristic(const Symmetric3d& C) {
  const double xx = C.entries[0], yy = C.entries[1], zz = C.entries[2];
  const double xy = C.entries[3], yz = C.entries[4], xz = C.entries[5];
  const double m0 = yy * zz - yz * yz, m1 = xx * zz - xz * xz, m2 = xx * yy - xy * xy;
  return {xx + yy + zz, m0 + m1 + m2, xx * m0 - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz)};
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

double least_root(const Cubic& c) {
  double x = 0;
  for (int i = 0; i < kMostEigenvalueSteps; ++i) {
    const double step = laguerre_step(c, x);
    x += step;
    if (std::abs(step) <= kEigenvalueTolerance * x) break;
  }
  return x;
}

Eigen::Vector3d roots(const Cubic& c, double least) {
  const double half_sum = 0.5 * (c.trace - least), product = c.minors - 2 * least * half_sum;
  const double half_difference = std::sqrt(std::max(0.0, half_sum * half_sum - product));
  return {least, half_sum - half_difference, half_sum + half_difference};
}

}  // namespace

Eigen::Vector3d eigenvalues(const Symmetric3d& covariance) {
  const Cubic c = characteristic(covariance);
  return roots(c, least_root(c));
}

Eigen::Vector3d smallest_eigenvector(const Symmetric3d& packed, double least) {
  const Eigen::Matrix3d covariance = packed.matrix();
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
