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
Matrix6d covariance_in_world(const Matrix6d& covariance, const Pose& T_world_body) {
  Matrix6d to_world = Matrix6d::Zero();
  to_world.topRightCorner<3, 3>() = T_world_body.linear();
  to_world.bottomLeftCorner<3, 3>() = T_world_body.linear();
  return to_world * covariance * to_world.transpose();
}

}  // namespace

std::vector<std::byte> serialize_odometry(const StampedPose& pose, const Matrix6d& covariance, const Frames& frames,
                                          Serialization serialization) {
  RosMessageWriter writer(serialization);
  writer.header(pose.stamp, frames.world, "Odometry");
  writer.text(frames.body);
  put(writer, pose.T_world_lidar);
  const Matrix6d in_world = covariance_in_world(covariance, pose.T_world_lidar);
  for (const double value : in_world.reshaped()) writer.f64(value);
  for (int i = 0; i < 2; ++i) put(writer, Eigen::Vector3d::Zero());
  for (int i = 0; i < 36; ++i) writer.f64(i == 0 ? -1.0 : 0.0);
  return writer.take();
}

std::vector<std::byte> serialize_tf(std::span<const StampedTransform> transforms, Serialization serialization) {
  RosMessageWriter writer(serialization);
  writer.u32(transforms.size());
  for (const StampedTransform& transform : transforms) {
    writer.header(transform.stamp, transform.frames.world, "TFMessage");
    writer.text(transform.frames.body);
    put(writer, transform.T_world_body);
  }
  return writer.take();
}

std::vector<std::byte> serialize_path(const Trajectory& trajectory, const Frames& frames, Serialization serialization) {
  RosMessageWriter writer(serialization);
  writer.header(trajectory.empty() ? 0.0 : trajectory.front().stamp, frames.world, "Path");
  writer.u32(trajectory.size());
  for (const StampedPose& pose : trajectory) {
    writer.header(pose.stamp, frames.world, "Path");
    put(writer, pose.T_world_lidar);
  }
  return writer.take();
}

}  // namespace tilth
