#include <tilth/messages/diagnostic_message.hpp>
#include <tilth/messages/ros_message_writer.hpp>

namespace tilth {

std::vector<std::byte> serialize_diagnostic(const Diagnostic& diagnostic, Serialization serialization) {
  RosMessageWriter writer(serialization);
  writer.header(diagnostic.stamp, "", "DiagnosticArray");
  writer.u32(1);
  writer.u8(std::uint8_t(diagnostic.level));
  writer.text(diagnostic.name);
  writer.text(diagnostic.message);
  writer.text("");  // hardware_id
  writer.u32(diagnostic.values.size());
  for (const auto& [key, value] : diagnostic.values) {
    writer.text(key);
    writer.text(value);
  }
  return writer.take();
}

}  // namespace tilth
