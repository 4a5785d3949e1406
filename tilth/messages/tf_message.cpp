#include <bit>
#include <cmath>

#include <tilth/core/error.hpp>
#include <tilth/messages/tf_message.hpp>

namespace tilth {
namespace {

double f64(RosMessageReader& reader, const char* field) {
  return std::bit_cast<double>(reader.number<std::uint64_t>(field));
}

Pose read_pose(RosMessageReader& reader) {
  constexpr double kUnit = 1e-3;  // of the quaternion's length
  Eigen::Vector3d translation;
  Eigen::Quaterniond rotation;
  for (int i = 0; i < 3; ++i) translation[i] = f64(reader, "translation");
  for (int i = 0; i < 4; ++i) rotation.coeffs()[i] = f64(reader, "rotation");
  if (!translation.allFinite()) throw Error("TFMessage translation", "is not finite");
  if (!(std::abs(rotation.norm() - 1.0) < kUnit)) throw Error("TFMessage rotation", "is no quaternion of length 1");
  return Eigen::Translation3d(translation) * rotation.normalized();
}

}  // namespace

std::vector<StampedTransform> parse_tf(std::span<const std::byte> message, Serialization serialization) {
  RosMessageReader reader(message, serialization, "TFMessage");
  std::vector<StampedTransform> transforms;
  for (auto left = reader.number<std::uint32_t>("transforms"); left > 0; --left) {
    const RosMessageReader::Header header = reader.header();
    StampedTransform transform{header.stamp, {header.frame_id, reader.text("child_frame_id")}};
    transform.T_world_body = read_pose(reader);
    transforms.push_back(std::move(transform));
  }
  return transforms;
}

}  // namespace tilth
