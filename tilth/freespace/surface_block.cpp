#include <Eigen/Eigenvalues>

#include <tilth/freespace/surface_block.hpp>

namespace tilth {

void GrowingPlane::refresh(float thickness) {
  constexpr float kFewest = 12, kGrowth = 1.5F, kFlat = 0.1F, kWide = 0.12F;
  if (count_ < kFewest || count_ < kGrowth * fitted_) return;
  fitted_ = count_;
  const Eigen::Vector3f mean = sum_ / count_;
  const Eigen::Matrix3f covariance = squares_ / count_ - mean * mean.transpose();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver;
  solver.computeDirect(covariance);
  const Eigen::Vector3f spread = solver.eigenvalues();
  planar_ = spread[0] < thickness * thickness && spread[0] < kFlat * spread[1];
  wide_ = planar_ && spread[1] > kWide * kWide;
  normal_ = solver.eigenvectors().col(0);
  distance_ = normal_.dot(mean);
}

}  // namespace tilth
