// The direction in which points spread least, and by how much: the least eigenvalue of a covariance and its
// eigenvector, without the trigonometry of a closed form. About 100 operations for what is flat.
#pragma once

#include <span>

#include <Eigen/Core>

namespace tilth {

/// The eigenvalues of a covariance [m^2], ascending.
Eigen::Vector3d spreads(const Eigen::Matrix3d& covariance);

/// The same of many covariances, each given by its entries xx, yy, zz, xy, yz, zx: a few times as fast. As many
/// `eigenvalues`.
void spreads(std::span<const Eigen::Matrix<double, 6, 1>> covariances, std::span<Eigen::Vector3d> eigenvalues);

/// The unit eigenvector of `covariance` to its eigenvalue `least`; any one where it spreads alike in several
/// directions.
Eigen::Vector3d direction_of_least(const Eigen::Matrix3d& covariance, double least);

}  // namespace tilth
