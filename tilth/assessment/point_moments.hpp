// Sums over the points of a cell, from which their mean and covariance follow.
#pragma once

#include <Eigen/Core>

namespace tilth {

struct PointMoments {
  double count = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();

  void add(const Eigen::Vector3d& p) {
    count += 1;
    sum += p;
    squares += p * p.transpose();
  }

  Eigen::Vector3d mean() const { return sum / count; }
  Eigen::Matrix3d covariance() const { return squares / count - mean() * mean().transpose(); }
};

}  // namespace tilth
