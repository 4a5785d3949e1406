// Second moments of points, such that those of two sets add up to those of both.
#pragma once

#include <tilth/core/symmetric3.hpp>

namespace tilth {

/// Sums of points about their mean.
struct Moments {
  double count = 0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();  ///< [m]
  Symmetric3d scatter = {};                        ///< [m^2] sum of (p - mean)(p - mean)^T

  void add(const Moments& other);
  Symmetric3d covariance() const;  ///< [m^2]
};

}  // namespace tilth
