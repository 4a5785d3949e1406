#include <algorithm>
#include <array>
#include <string>

#include <tilth/core/error.hpp>
#include <tilth/messages/packet_message.hpp>

namespace tilth {
namespace {

constexpr std::array<std::string_view, 3> kScans{"VelodyneScan", "LslidarC16ScanUnified", "PandarScan"};
constexpr std::array<std::string_view, 4> kSingles{"VelodynePacket", "LslidarPacket", "LslidarC16Packet",
                                                   "PandarPacket"};
constexpr std::array<std::string_view, 2> kSized{"PandarScan", "PandarPacket"};    ///< packets tell how much is filled
constexpr std::array<std::string_view, 2> kBuffers{"PacketMsg", "RslidarPacket"};  ///< one packet of any length
constexpr std::string_view kRobosense = "RslidarPacket";  ///< with a header; of Ouster's PacketMsg the bytes are all
constexpr std::size_t kRoom = 1500;                       ///< [bytes] of such a packet
constexpr std::array<std::size_t, 2> kSizes{1206, 1212};
constexpr std::size_t kStamp = 8;

bool among(std::span<const std::string_view> names, std::string_view type) {
  const std::string_view name = type.substr(type.rfind('/') + 1);
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// [bytes] of a packet's data, which the message does not tell: the size that fills it.
std::size_t packet_size(const RosMessageReader& reader, std::size_t count) {
  for (const std::size_t size : kSizes) {
    const std::size_t whole = kStamp + size;
    const std::size_t stride = reader.serialization() == Serialization::cdr ? (whole + 3) / 4 * 4 : whole;
    const std::size_t needed = (count - 1) * stride + whole;
    if (reader.left() >= needed && reader.left() < needed + 4) return size;
  }
  throw Error("packets", "of " + std::to_string(count) + " in " + std::to_string(reader.left()) +
                             " bytes are neither of 1206 nor of 1212 bytes");
}

StampedPayload sized_packet(RosMessageReader& reader) {
  const double stamp = reader.time("packets.stamp");
  const std::span<const std::byte> room = reader.bytes(kRoom, "packets.data");
  const auto size = reader.number<std::uint32_t>("packets.size");
  if (size > kRoom) throw Error("packets.size", std::to_string(size) + " is more than " + std::to_string(kRoom));
  return {stamp, room.first(size)};
}

StampedPayload packet_of(RosMessageReader& reader, std::size_t size) {
  const double stamp = reader.time("packets.stamp");
  return {stamp, reader.bytes(size, "packets.data")};
}

/// A sequence of bytes; of a RoboSense behind a header and two flags.
StampedPayload buffered_packet(RosMessageReader& reader, bool robosense) {
  double stamp = 0.0;
  if (robosense) {
    stamp = reader.header().stamp;
    reader.number<std::uint8_t>("is_difop"), reader.number<std::uint8_t>("is_frame_begin");
  }
  const auto size = reader.number<std::uint32_t>("data");
  return {stamp, reader.bytes(size, "data")};
}

}  // namespace

bool is_packet_message(std::string_view type) {
  return among(kScans, type) || among(kSingles, type) || among(kBuffers, type);
}

std::string packet_message_frame(std::string_view type, std::span<const std::byte> message,
                                 Serialization serialization) {
  if (!among(kScans, type) && !type.ends_with(kRobosense)) return "";
  return RosMessageReader(message, serialization, std::string(type)).header().frame_id;
}

std::vector<StampedPayload> parse_packet_message(std::string_view type, std::span<const std::byte> message,
                                                 Serialization serialization) {
  RosMessageReader reader(message, serialization, std::string(type));
  if (among(kBuffers, type)) return {buffered_packet(reader, type.ends_with(kRobosense))};
  std::size_t count = 1;
  if (among(kScans, type)) {
    reader.header();
    count = reader.number<std::uint32_t>("packets");
  }
  if (count == 0) return {};
  const bool sized = among(kSized, type);
  const std::size_t size = sized ? 0 : packet_size(reader, count);
  std::vector<StampedPayload> packets;
  for (std::size_t i = 0; i < count; ++i) packets.push_back(sized ? sized_packet(reader) : packet_of(reader, size));
  return packets;
}

}  // namespace tilth
