// R C R^T of a symmetric matrix, of which only the upper half is worked out: 45 products instead of 54, and symmetric
// to the last bit.
#pragma once

#include <Eigen/Core>

namespace tilth {

inline Eigen::Matrix3d rotated(const Eigen::Matrix3d& R, const Eigen::Matrix3d& C) {
  const Eigen::Matrix3d RC = R * C;
  const auto entry = [&](int i, int j) { return RC(i, 0) * R(j, 0) + RC(i, 1) * R(j, 1) + RC(i, 2) * R(j, 2); };
  const double xy = entry(0, 1), xz = entry(0, 2), yz = entry(1, 2);
  Eigen::Matrix3d result;
  result << entry(0, 0), xy, xz, xy, entry(1, 1), yz, xz, yz, entry(2, 2);
  return result;
}

}  // namespace tilth
