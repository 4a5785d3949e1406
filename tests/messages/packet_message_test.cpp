// Packets in ROS messages, and the alignment and byte orders of CDR.
#include <sensor/made_packets.hpp>

#include <gtest/gtest.h>

#include <tilth/core/error.hpp>
#include <tilth/messages/packet_message.hpp>

namespace tilth {
namespace {

using Bytes = std::vector<std::byte>;

/// Numbers as CDR lays them out after its header of 4 bytes.
class Cdr {
 public:
  explicit Cdr(unsigned kind)
      : bytes_{std::byte(0), std::byte(kind), std::byte(0), std::byte(0)}, little_(kind % 2 == 1) {}

  Cdr& number(std::uint64_t value, std::size_t size, std::size_t alignment) {
    while ((bytes_.size() - 4) % alignment != 0) bytes_.push_back(std::byte(0xEE));
    for (std::size_t i = 0; i < size; ++i)
      bytes_.push_back(std::byte(value >> 8 * (little_ ? i : size - 1 - i) & 0xFF));
    return *this;
  }
  Cdr& raw(const Bytes& more) {
    bytes_.insert(bytes_.end(), more.begin(), more.end());
    return *this;
  }
  const Bytes& bytes() const { return bytes_; }

 private:
  Bytes bytes_;
  bool little_;
};

Bytes text(std::string_view value) {
  Bytes bytes;
  for (const char c : value) bytes.push_back(std::byte(c));
  return bytes;
}

TEST(RosMessage, CdrIsAlignedInEitherByteOrder) {
  for (const auto& [kind, widest] : {std::pair{0U, 8U}, std::pair{1U, 8U}, std::pair{6U, 4U}, std::pair{7U, 4U}}) {
    Cdr made(kind);
    made.number(7, 1, 1).number(0x1234, 2, 2).number(9, 1, 1).number(0x123456789ABCDEF0, 8, widest);
    made.number(4, 4, 4).raw(text(std::string_view("abc\0", 4))).number(5, 4, 4);
    RosMessageReader reader(made.bytes(), Serialization::cdr, "Test");
    EXPECT_EQ(reader.number<std::uint8_t>("a"), 7);
    EXPECT_EQ(reader.number<std::uint16_t>("b"), 0x1234);
    EXPECT_EQ(reader.number<std::uint8_t>("c"), 9);
    EXPECT_EQ(reader.number<std::uint64_t>("d"), 0x123456789ABCDEF0U) << kind;
    EXPECT_EQ(reader.text("e"), "abc");
    EXPECT_EQ(reader.number<std::uint32_t>("f"), 5U);
    EXPECT_THROW(reader.number<std::uint8_t>("g"), Error);
  }
  EXPECT_THROW(RosMessageReader(Cdr(3).bytes(), Serialization::cdr, "Test"), Error) << "a parameter list";
  EXPECT_THROW(RosMessageReader(text("abc"), Serialization::cdr, "Test"), Error);
}

Bytes little(std::uint32_t value) {
  return Bytes{std::byte(value & 0xFF), std::byte(value >> 8 & 0xFF), std::byte(value >> 16 & 0xFF),
               std::byte(value >> 24)};
}

Bytes joined(std::initializer_list<Bytes> parts) {
  Bytes all;
  for (const Bytes& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

TEST(PacketMessage, ScansOfRos1AndRos2GiveTheirPackets) {
  const MadeSensor sensor;
  const Bytes a = sensor.packet(0).bytes(), b = sensor.packet(1).bytes();
  const Bytes ros1 = joined({little(3), little(100), little(0), little(8), text("velodyne"), little(2), little(99),
                             little(500'000'000), a, little(100), little(0), b});
  Cdr ros2(1);
  ros2.number(100, 4, 4).number(0, 4, 4).number(9, 4, 4).raw(text(std::string_view("velodyne\0", 9))).number(2, 4, 4);
  ros2.number(99, 4, 4).number(500'000'000, 4, 4).raw(a).number(100, 4, 4).number(0, 4, 4).raw(b);
  const auto check = [&](const std::vector<StampedPayload>& packets) {
    ASSERT_EQ(packets.size(), 2U);
    EXPECT_DOUBLE_EQ(packets[0].stamp, 99.5);
    EXPECT_DOUBLE_EQ(packets[1].stamp, 100.0);
    EXPECT_TRUE(std::equal(a.begin(), a.end(), packets[0].payload.begin(), packets[0].payload.end()));
    EXPECT_TRUE(std::equal(b.begin(), b.end(), packets[1].payload.begin(), packets[1].payload.end()));
  };
  check(parse_packet_message("velodyne_msgs/VelodyneScan", ros1, Serialization::ros1));
  check(parse_packet_message("velodyne_msgs/msg/VelodyneScan", ros2.bytes(), Serialization::cdr));
  for (std::size_t size = 0; size < ros1.size(); ++size) {
    const std::span<const std::byte> cut(ros1.data(), size);
    EXPECT_THROW(parse_packet_message("velodyne_msgs/VelodyneScan", cut, Serialization::ros1), Error) << size;
  }
}

TEST(PacketMessage, SinglePacketsOfLeishenHaveEitherLength) {
  for (const std::size_t size : {1206U, 1212U}) {
    const Bytes payload(size, std::byte(1));
    const Bytes message = joined({little(5), little(0), payload});
    const auto packets = parse_packet_message("lslidar_msgs/LslidarPacket", message, Serialization::ros1);
    ASSERT_EQ(packets.size(), 1U);
    EXPECT_EQ(packets[0].payload.size(), size);
  }
  EXPECT_THROW(parse_packet_message("lslidar_msgs/LslidarPacket", Bytes(900), Serialization::ros1), Error);
  EXPECT_TRUE(is_packet_message("velodyne_msgs/msg/VelodyneScan"));
  EXPECT_TRUE(is_packet_message("pandar_msgs/msg/PandarScan"));
  EXPECT_FALSE(is_packet_message("sensor_msgs/PointCloud2"));
}

TEST(PacketMessage, PacketsOfHesaiTellHowMuchOfTheirRoomIsFilled) {
  const Bytes room(1500, std::byte(3));
  const auto message = [&](std::uint32_t size) {
    return joined({little(3), little(100), little(0), little(0), little(2), little(99), little(0), room, little(568),
                   little(100), little(0), room, little(size)});
  };
  const Bytes good = message(1500);
  const auto packets = parse_packet_message("pandar_msgs/PandarScan", good, Serialization::ros1);
  ASSERT_EQ(packets.size(), 2U);
  EXPECT_EQ(packets[0].payload.size(), 568U);
  EXPECT_EQ(packets[1].payload.size(), 1500U);
  EXPECT_DOUBLE_EQ(packets[1].stamp, 100.0);
  EXPECT_THROW(parse_packet_message("pandar_msgs/PandarScan", message(1501), Serialization::ros1), Error);
  for (std::size_t size = 0; size < good.size(); size += 7) {
    const std::span<const std::byte> cut(good.data(), size);
    EXPECT_THROW(parse_packet_message("pandar_msgs/PandarScan", cut, Serialization::ros1), Error) << size;
  }
}

TEST(PacketMessage, PacketsOfAnyLengthAreReadInBothSerialisations) {
  const Bytes payload = text("packet of a sensor");
  Cdr ouster(1);
  ouster.number(payload.size(), 4, 4).raw(payload);
  const auto read = parse_packet_message("ouster_ros/msg/PacketMsg", ouster.bytes(), Serialization::cdr);
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(Bytes(read[0].payload.begin(), read[0].payload.end()), payload);
  EXPECT_EQ(read[0].stamp, 0.0);

  Cdr robosense(1);
  robosense.number(17, 4, 4).number(500'000'000, 4, 4).number(3, 4, 4).raw(text(std::string_view("rs\0", 3)));
  robosense.number(0, 1, 1).number(1, 1, 1).number(payload.size(), 4, 4).raw(payload);
  constexpr const char* kType = "rslidar_msg/msg/RslidarPacket";
  const auto same = parse_packet_message(kType, robosense.bytes(), Serialization::cdr);
  ASSERT_EQ(same.size(), 1U);
  EXPECT_EQ(Bytes(same[0].payload.begin(), same[0].payload.end()), payload);
  EXPECT_NEAR(same[0].stamp, 17.5, 1e-9);
  EXPECT_EQ(packet_message_frame(kType, robosense.bytes(), Serialization::cdr), "rs");
  Bytes cut = robosense.bytes();
  cut.pop_back();
  EXPECT_THROW(parse_packet_message(kType, cut, Serialization::cdr), Error);
}

}  // namespace
}  // namespace tilth
