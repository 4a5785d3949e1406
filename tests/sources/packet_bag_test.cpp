// A ROS 1 bag with velodyne_msgs/VelodyneScan gives the scans of the capture with the same packets.
#include <io/temporary_folder.hpp>

#include <gtest/gtest.h>

#include <tilth/core/error.hpp>
#include <tilth/io/pcap_writer.hpp>
#include <tilth/io/rosbag1_writer.hpp>
#include <tilth/sensor/packet_encoder.hpp>
#include <tilth/simulation/simulator.hpp>
#include <tilth/sources/open_source.hpp>

namespace tilth {
namespace {

void put(std::vector<std::byte>& bytes, std::uint32_t value) {
  for (int i = 0; i < 4; ++i) bytes.push_back(std::byte(value >> 8 * i & 0xFF));
}

/// Header (seq, stamp, frame) and packets with their stamps.
std::vector<std::byte> scan_message(const std::vector<EncodedPacket>& packets, const std::string& frame = "") {
  std::vector<std::byte> bytes(12);
  put(bytes, std::uint32_t(frame.size()));
  for (const char c : frame) bytes.push_back(std::byte(c));
  put(bytes, std::uint32_t(packets.size()));
  for (const EncodedPacket& packet : packets) {
    put(bytes, std::uint32_t(packet.sent));
    put(bytes, std::uint32_t((packet.sent - std::uint32_t(packet.sent)) * 1e9));
    bytes.insert(bytes.end(), packet.payload.begin(), packet.payload.end());
  }
  return bytes;
}

TEST(PacketBag, GivesTheScansOfItsPackets) {
  const TemporaryFolder folder;
  const Simulator made("corridor", simulation_options("corridor", {{"duration", "0.8"}}));
  const PacketFormat format = packet_format_of(made.lidar());
  PcapWriter capture(folder / "a.pcap");
  Rosbag1Writer bag(folder / "a.bag");
  const std::uint32_t id = bag.add_connection({0, "/velodyne_packets", "velodyne_msgs/VelodyneScan", "0", "x", 0});
  for (std::size_t i = 0; i < made.size(); ++i) {
    const std::vector<EncodedPacket> packets = encode_scan(made.scan(i).scan, made.lidar(), format);
    for (const EncodedPacket& packet : packets) capture.write(packet.sent, {1, 2, 2368, 2368}, packet.payload);
    bag.write(id, std::uint64_t(packets.back().sent * 1e9), scan_message(packets));
  }
  capture.close();
  bag.close();
  const auto expected = open_source((folder / "a.pcap").string(), {});
  const auto read = open_source((folder / "a.bag").string(), {});
  EXPECT_EQ(read->contents().front(), "topic /velodyne_packets: velodyne_msgs/VelodyneScan, 7 messages");
  std::size_t scans = 0;
  for (; const auto scan = read->next(); ++scans) {
    const auto same = expected->next();
    ASSERT_TRUE(same);
    EXPECT_EQ(scan->cloud.points, same->cloud.points);
    EXPECT_NEAR(scan->stamp, same->stamp, 1e-6);
  }
  EXPECT_EQ(scans, made.size());
  EXPECT_FALSE(expected->next());
  EXPECT_THROW(open_source((folder / "a.bag").string(), {.topic = "/points"}), Error);
}

TEST(PacketBag, OfTwoSensorsOneIsReadAndTold) {
  const TemporaryFolder folder;
  const Simulator front("corridor", simulation_options("corridor", {{"duration", "0.8"}}));
  const Simulator rear("plaza", simulation_options("plaza", {{"duration", "0.8"}}));
  const PacketFormat format = packet_format_of(front.lidar());
  Rosbag1Writer bag(folder / "a.bag");
  const std::uint32_t id = bag.add_connection({0, "/packets", "velodyne_msgs/VelodyneScan", "0", "x", 0});
  for (std::size_t i = 0; i < front.size(); ++i) {
    for (const Simulator* sensor : {&front, &rear}) {
      const std::vector<EncodedPacket> packets = encode_scan(sensor->scan(i).scan, front.lidar(), format);
      bag.write(id, std::uint64_t(packets.back().sent * 1e9),
                scan_message(packets, sensor == &front ? "front" : "rear"));
    }
  }
  bag.close();
  const auto source = open_source((folder / "a.bag").string(), {});
  std::size_t scans = 0;
  for (; const auto scan = source->next(); ++scans)
    EXPECT_NEAR(double(scan->cloud.size()), double(front.scan(scans).scan.cloud.size()), 100.0);
  EXPECT_EQ(scans, front.size());
  const std::vector<std::string> notices = source->notices();
  EXPECT_NE(notices.back().find("those of other sensors on the same topic: 'rear'"), std::string::npos)
      << notices.back();
}

}  // namespace
}  // namespace tilth
