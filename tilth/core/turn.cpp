#include <Eigen/Geometry>

#include <tilth/core/turn.hpp>

namespace tilth {

Eigen::Matrix3d least_turn(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return Eigen::Quaterniond::FromTwoVectors(from, to).toRotationMatrix();
}

}  // namespace tilth
