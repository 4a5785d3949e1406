// Second moments of points, such that those of two sets add up to those of both.
#pragma once

#include <Eigen/Core>

#include <tilth/core/se3.hpp>

namespace tilth {

/// Sums of points about their mean: second moments xx, yy, zz, xy, yz, zx.
struct Moments {
  double count = 0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();  ///< [m]
  Vector6d scatter = Vector6d::Zero();             ///< [m^2] sum of the products of p - mean

  void add(const Moments& other);
  Vector6d covariance_entries() const;  ///< [m^2] xx, yy, zz, xy, yz, zx
  Eigen::Matrix3d covariance() const;   ///< [m^2]
};

}  // namespace tilth
