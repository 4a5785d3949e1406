#include <algorithm>

#include <tilth/features/moments.hpp>

namespace tilth {

void Moments::add(const Moments& other) {
  const double total = count + other.count, ratio = other.count / total;
  const Eigen::Vector3d d = other.mean - mean;
  Vector6d products;
  products << d.x() * d.x(), d.y() * d.y(), d.z() * d.z(), d.x() * d.y(), d.y() * d.z(), d.z() * d.x();
  scatter += other.scatter + (count * ratio) * products;
  mean += d * ratio;
  count = total;
}

Vector6d Moments::covariance_entries() const {
  return scatter * (1 / std::max(1.0, count - 1));
}

Eigen::Matrix3d Moments::covariance() const {
  const Vector6d c = covariance_entries();
  Eigen::Matrix3d covariance;
  covariance << c[0], c[3], c[5], c[3], c[1], c[4], c[5], c[4], c[2];
  return covariance;
}

}  // namespace tilth
