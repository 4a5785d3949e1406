#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include <tilth/core/least_spread.hpp>

namespace tilth {
namespace {

// The least root of the characteristic polynomial  x^3 - trace x^2 + minors x - determinant,  all of whose roots are
// real and none negative: Newton's method from 0 ascends to it, at once where it stands alone.
double least_root(double trace, double minors, double determinant) {
  constexpr int kMostSteps = 40;  // a triple root is approached by a third of the way each
  double x = 0;
  for (int i = 0; i < kMostSteps; ++i) {
    const double value = ((x - trace) * x + minors) * x - determinant;
    const double slope = (3 * x - 2 * trace) * x + minors;
    if (slope <= 0) break;
    const double step = value / slope;
    x -= step;
    if (std::abs(step) <= 1e-9 * x) break;
  }
  return x;
}

}  // namespace

Eigen::Vector3d spreads(const Eigen::Matrix3d& C) {
  const double trace = C.trace();
  const double m0 = C(1, 1) * C(2, 2) - C(1, 2) * C(1, 2);
  const double m1 = C(0, 0) * C(2, 2) - C(0, 2) * C(0, 2);
  const double m2 = C(0, 0) * C(1, 1) - C(0, 1) * C(0, 1);
  const double determinant = C(0, 0) * m0 - C(0, 1) * (C(0, 1) * C(2, 2) - C(1, 2) * C(0, 2)) +
                             C(0, 2) * (C(0, 1) * C(1, 2) - C(1, 1) * C(0, 2));
  const double minors = m0 + m1 + m2, least = least_root(trace, minors, determinant);
  const double half_sum = 0.5 * (trace - least), product = minors - 2 * least * half_sum;
  const double half_difference = std::sqrt(std::max(0.0, half_sum * half_sum - product));
  return {least, half_sum - half_difference, half_sum + half_difference};
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
