// What is known of the surfaces in a block of cells: where each cell's voxels are kept, and whether all is one plane.
#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>

namespace tilth {

class SurfaceBlock {
 public:
  static constexpr std::uint32_t kNoCell = 0xFFFFFFFF;

  /// `origin`: a point near by, from which sums are taken.
  explicit SurfaceBlock(const Eigen::Vector3f& origin) : origin_(origin) { cells.fill(kNoCell); }

  std::array<std::uint32_t, 64> cells;  ///< number of each cell's voxels, or kNoCell

  void add(const Eigen::Vector3f& point) {
    const Eigen::Vector3f p = point - origin_;
    count_ += 1;
    sum_ += p;
    squares_.col(0) += p.x() * p;
    squares_.col(1) += p.y() * p;
    squares_.col(2) += p.z() * p;
  }

  /// Fits the plane anew where half as many points again have come; points thinner than `thickness` [m] are one.
  void refresh(float thickness);

  bool planar() const { return planar_; }

  /// [m] of `point` from the plane, where there is one.
  float offset(const Eigen::Vector3f& point) const { return normal_.dot(point) - distance_; }

  /// [-] sine of the angle between a direction and the plane.
  float sine(const Eigen::Vector3f& direction) const { return normal_.dot(direction); }

 private:
  Eigen::Vector3f origin_, sum_ = Eigen::Vector3f::Zero(), normal_ = Eigen::Vector3f::Zero();
  Eigen::Matrix3f squares_ = Eigen::Matrix3f::Zero();
  float count_ = 0, fitted_ = 0, distance_ = 0;
  bool planar_ = false;
};

}  // namespace tilth
