#include <tilth/messages/pose_fields.hpp>
#include <tilth/messages/pose_message.hpp>
#include <tilth/messages/ros_message_writer.hpp>

namespace tilth {

std::vector<std::byte> serialize_odometry(const StampedPose& pose, const Matrix6d& covariance, const Frames& frames,
                                          Serialization serialization) {
  RosMessageWriter writer(serialization);
  writer.header(pose.stamp, frames.world, "Odometry");
  writer.text(frames.body);
  write_pose(writer, pose.T_world_lidar);
  write_covariance(writer, covariance, pose.T_world_lidar);
  for (int i = 0; i < 6; ++i) writer.f64(0.0);
  for (int i = 0; i < 36; ++i) writer.f64(i == 0 ? -1.0 : 0.0);
  return writer.take();
}

std::vector<std::byte> serialize_tf(std::span<const StampedTransform> transforms, Serialization serialization) {
  RosMessageWriter writer(serialization);
  writer.u32(transforms.size());
  for (const StampedTransform& transform : transforms) {
    writer.header(transform.stamp, transform.frames.world, "TFMessage");
    writer.text(transform.frames.body);
    write_pose(writer, transform.T_world_body);
  }
  return writer.take();
}

std::vector<std::byte> serialize_path(const Trajectory& trajectory, const Frames& frames, Serialization serialization) {
  RosMessageWriter writer(serialization);
  writer.header(trajectory.empty() ? 0.0 : trajectory.front().stamp, frames.world, "Path");
  writer.u32(trajectory.size());
  for (const StampedPose& pose : trajectory) {
    writer.header(pose.stamp, frames.world, "Path");
    write_pose(writer, pose.T_world_lidar);
  }
  return writer.take();
}

}  // namespace tilth
