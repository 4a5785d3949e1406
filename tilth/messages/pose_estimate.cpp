#include <tilth/messages/pose_estimate.hpp>
#include <tilth/messages/pose_fields.hpp>

namespace tilth {
namespace {

const std::string kType = "PoseWithCovarianceStamped";

}  // namespace

std::vector<std::byte> serialize_pose_estimate(const StampedPose& pose, const Matrix6d& covariance,
                                               const std::string& world, Serialization serialization) {
  RosMessageWriter writer(serialization);
  writer.header(pose.stamp, world, kType);
  write_pose(writer, pose.T_world_lidar);
  write_covariance(writer, covariance, pose.T_world_lidar);
  return writer.take();
}

PoseGuess parse_pose_guess(std::span<const std::byte> message, Serialization serialization) {
  RosMessageReader reader(message, serialization, kType);
  std::string world = reader.header().frame_id;
  const Pose T_world_body = read_pose(reader, kType);
  for (int i = 0; i < 36; ++i) reader.number<std::uint64_t>("covariance");
  return {std::move(world), T_world_body};
}

}  // namespace tilth
