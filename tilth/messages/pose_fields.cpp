#include <bit>
#include <cmath>

#include <tilth/core/error.hpp>
#include <tilth/messages/pose_fields.hpp>

namespace tilth {
namespace {

double f64(RosMessageReader& reader, const char* field) {
  return std::bit_cast<double>(reader.number<std::uint64_t>(field));
}

}  // namespace

Pose read_pose(RosMessageReader& reader, const std::string& type) {
  constexpr double kUnit = 1e-3;  // of the quaternion's length
  Eigen::Vector3d translation;
  Eigen::Quaterniond rotation;
  for (int i = 0; i < 3; ++i) translation[i] = f64(reader, "translation");
  for (int i = 0; i < 4; ++i) rotation.coeffs()[i] = f64(reader, "rotation");
  if (!translation.allFinite()) throw Error(type + " translation", "is not finite");
  if (!(std::abs(rotation.norm() - 1.0) < kUnit)) throw Error(type + " rotation", "is no quaternion of length 1");
  return Eigen::Translation3d(translation) * rotation.normalized();
}

void write_pose(RosMessageWriter& writer, const Pose& pose) {
  const Eigen::Vector3d translation = pose.translation();
  const Eigen::Quaterniond rotation(pose.linear());
  for (int i = 0; i < 3; ++i) writer.f64(translation[i]);
  for (int i = 0; i < 4; ++i) writer.f64(rotation.coeffs()[i]);
}

void write_covariance(RosMessageWriter& writer, const Matrix6d& covariance, const Pose& T_world_body) {
  Matrix6d to_world = Matrix6d::Zero();
  to_world.topRightCorner<3, 3>() = T_world_body.linear();
  to_world.bottomLeftCorner<3, 3>() = T_world_body.linear();
  const Matrix6d in_world = to_world * covariance * to_world.transpose();
  for (const double value : in_world.reshaped()) writer.f64(value);
}

}  // namespace tilth
