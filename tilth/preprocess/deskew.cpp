#include <tilth/preprocess/deskew.hpp>

namespace tilth {

PointCloud deskew(const PointCloud& cloud, const Vector6d& velocity, double reference_time) {
  PointCloud still = cloud;
  if (!cloud.has_times() || velocity.isZero(0)) return still;
  for (std::size_t i = 0; i < still.size(); ++i) {
    const Pose T_reference_point = exp(velocity * (double(cloud.times[i]) - reference_time));
    still.points[i] = T_reference_point * cloud.points[i];
    if (cloud.covariances.empty()) continue;
    const Eigen::Matrix3d R = T_reference_point.linear();
    still.covariances[i] = R * cloud.covariances[i] * R.transpose();
  }
  return still;
}

}  // namespace tilth
