#include <tilth/messages/pose_message.hpp>
#include <tilth/messages/ros_message_writer.hpp>

namespace tilth {
namespace {

void put(RosMessageWriter& writer, const Eigen::Vector3d& v) {
  writer.f64(v.x());
  writer.f64(v.y());
  writer.f64(v.z());
}

void put(RosMessageWriter& writer, const Pose& pose) {
  put(writer, Eigen::Vector3d(pose.translation()));
  const Eigen::Quaterniond q(pose.linear());
  put(writer, Eigen::Vector3d(q.vec()));
  writer.f64(q.w());
}

/// In ROS's order, translation first, and in the world's axes.
Matrix6d covariance_in_world(const Vector6d& variances, const Pose& T_world_lidar) {
  const Eigen::Matrix3d R = T_world_lidar.linear();
  Matrix6d covariance = Matrix6d::Zero();
  covariance.topLeftCorner<3, 3>() = R * variances.tail<3>().asDiagonal() * R.transpose();
  covariance.bottomRightCorner<3, 3>() = R * variances.head<3>().asDiagonal() * R.transpose();
  return covariance;
}

}  // namespace

std::vector<std::byte> serialize_odometry(const StampedPose& pose, const Vector6d& variances, const Frames& frames) {
  RosMessageWriter writer(Serialization::cdr);
  writer.header(pose.stamp, frames.world, "Odometry");
  writer.text(frames.lidar);
  put(writer, pose.T_world_lidar);
  const Matrix6d covariance = covariance_in_world(variances, pose.T_world_lidar);
  for (const double value : covariance.reshaped()) writer.f64(value);
  for (int i = 0; i < 2; ++i) put(writer, Eigen::Vector3d::Zero());
  for (int i = 0; i < 36; ++i) writer.f64(i == 0 ? -1.0 : 0.0);
  return writer.take();
}

std::vector<std::byte> serialize_tf(const StampedPose& pose, const Frames& frames) {
  RosMessageWriter writer(Serialization::cdr);
  writer.u32(1);
  writer.header(pose.stamp, frames.world, "TFMessage");
  writer.text(frames.lidar);
  put(writer, pose.T_world_lidar);
  return writer.take();
}

std::vector<std::byte> serialize_path(const Trajectory& trajectory, const Frames& frames) {
  RosMessageWriter writer(Serialization::cdr);
  writer.header(trajectory.empty() ? 0.0 : trajectory.front().stamp, frames.world, "Path");
  writer.u32(trajectory.size());
  for (const StampedPose& pose : trajectory) {
    writer.header(pose.stamp, frames.world, "Path");
    put(writer, pose.T_world_lidar);
  }
  return writer.take();
}

}  // namespace tilth
