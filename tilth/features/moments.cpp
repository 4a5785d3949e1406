#include <algorithm>

#include <tilth/features/moments.hpp>

namespace tilth {

void Moments::add(const Moments& other) {
  const double total = count + other.count, ratio = other.count / total;
  const Eigen::Vector3d d = other.mean - mean;
  scatter += other.scatter + (count * ratio) * Symmetric3d::product(d, d);
  mean += d * ratio;
  count = total;
}

Symmetric3d Moments::covariance() const {
  return (1 / std::max(1.0, count - 1)) * scatter;
}

}  // namespace tilth
