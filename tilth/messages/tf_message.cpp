#include <tilth/messages/pose_fields.hpp>
#include <tilth/messages/tf_message.hpp>

namespace tilth {

std::vector<StampedTransform> parse_tf(std::span<const std::byte> message, Serialization serialization) {
  RosMessageReader reader(message, serialization, "TFMessage");
  std::vector<StampedTransform> transforms;
  for (auto left = reader.number<std::uint32_t>("transforms"); left > 0; --left) {
    const RosMessageReader::Header header = reader.header();
    StampedTransform transform{header.stamp, {header.frame_id, reader.text("child_frame_id")}};
    transform.T_world_body = read_pose(reader, "TFMessage");
    transforms.push_back(std::move(transform));
  }
  return transforms;
}

}  // namespace tilth
