#include <cmath>

#include <Eigen/Eigenvalues>

#include <tilth/core/symmetric6.hpp>
#include <tilth/slam/submap_information.hpp>

namespace tilth {
namespace {

// Unit: metres that a typical point moves, for rotations as well.
Vector6d arc_scale(const SurfacePatches& patches) {
  double squares = 0;
  for (const SurfacePatch& patch : patches) squares += patch.mean.squaredNorm();
  Vector6d scale = Vector6d::Ones();
  scale.head<3>().setConstant(1 / std::max(0.1, std::sqrt(squares / std::max(1.0, double(patches.size())))));
  return scale;
}

}  // namespace

SubmapInformation weighed_information(const Matrix6d& information, const SurfacePatches& source,
                                      const InformationOptions& options) {
  const Vector6d scale = arc_scale(source);
  const Eigen6d eigen = eigen_of(scale.asDiagonal() * information * scale.asDiagonal());
  const double weakest = options.degeneracy_ratio * eigen.values[5];
  SubmapInformation weighed;
  Vector6d weights = Vector6d::Zero();
  for (int i = 0; i < 6; ++i) {
    const double strength = eigen.values[i];
    if (!(strength > 0) || strength < weakest)
      ++weighed.degenerate_directions;
    else
      weights[i] = 1 / (options.variance_scale / strength + options.noise * options.noise);
  }
  const Matrix6d back = scale.cwiseInverse().asDiagonal() * eigen.vectors;
  weighed.information = back * weights.asDiagonal() * back.transpose();
  return weighed;
}

Eigen::Vector3d weakest_axis(const Matrix6d& information) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(information.bottomRightCorner<3, 3>()).eigenvectors().col(0);
}

}  // namespace tilth
