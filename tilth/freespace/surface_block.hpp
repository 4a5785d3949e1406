// Whether the points in a block of space are one plane, or else the lowest of them: a floor on which something stands.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include <Eigen/Core>

namespace tilth {

/// A plane through points that come one by one.
class GrowingPlane {
 public:
  void add(const Eigen::Vector3f& p) {
    count_ += 1;
    sum_ += p;
    squares_.col(0) += p.x() * p;
    squares_.col(1) += p.y() * p;
    squares_.col(2) += p.z() * p;
  }

  /// Fits the plane anew where half as many points again have come; points thinner than `thickness` [m] are one.
  void refresh(float thickness);

  bool planar() const { return planar_; }
  bool wide() const { return wide_; }  ///< a plane that spreads in both directions
  float offset(const Eigen::Vector3f& p) const { return normal_.dot(p) - distance_; }    ///< [m] from the plane
  float sine(const Eigen::Vector3f& direction) const { return normal_.dot(direction); }  ///< of the angle to it

 private:
  Eigen::Vector3f sum_ = Eigen::Vector3f::Zero(), normal_ = Eigen::Vector3f::Zero();
  Eigen::Matrix3f squares_ = Eigen::Matrix3f::Zero();
  float count_ = 0, fitted_ = 0, distance_ = 0;
  bool planar_ = false, wide_ = false;
};

class SurfaceBlock {
 public:
  /// `origin`: a point near by, from which sums are taken.
  explicit SurfaceBlock(const Eigen::Vector3f& origin) : origin_(origin) {}

  /// A point that a scan saw; scans must come in their order.
  void add(const Eigen::Vector3f& point, std::uint32_t scan, float thickness) {
    constexpr float kLayer = 0.15F, kLower = 0.05F;  // [m]
    const Eigen::Vector3f p = point - origin_;
    if (first_ == 0) first_ = scan;
    last_ = scan;
    all_.add(p), all_.refresh(thickness);
    if (p.z() < low_ - kLower) low_ = p.z(), lowest_ = {};
    if (p.z() < low_ + kLayer) lowest_.add(p), lowest_.refresh(thickness);
  }

  /// Whether a beam in that direction grazes a plane, at an angle of less than `sine`, that the point lies within
  /// `clearance` [m] of.
  bool grazes(const Eigen::Vector3f& point, const Eigen::Vector3f& direction, float clearance, float sine) const {
    const GrowingPlane& plane = this->plane();
    return plane.planar() && std::abs(plane.sine(direction)) < sine &&
           std::abs(plane.offset(point - origin_)) < clearance;
  }

  /// Whether the point lies within `thickness` [m] of a plane that was there for so many scans.
  bool holds(const Eigen::Vector3f& point, std::uint32_t scans, float thickness) const {
    return all_.wide() && last_ - first_ >= scans && std::abs(all_.offset(point - origin_)) < thickness;
  }

 private:
  const GrowingPlane& plane() const { return all_.planar() ? all_ : lowest_; }

  Eigen::Vector3f origin_;
  std::uint32_t first_ = 0, last_ = 0;                  // scans that saw it
  float low_ = std::numeric_limits<float>::infinity();  // [m]
  GrowingPlane all_, lowest_;
};

}  // namespace tilth
