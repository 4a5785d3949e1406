// A simulated recording written as network packets and read back: the same scans within the packets' quantisation.
#include <cmath>
#include <io/temporary_folder.hpp>
#include <numbers>
#include <numeric>

#include <gtest/gtest.h>

#include <tilth/core/error.hpp>
#include <tilth/io/output_file.hpp>
#include <tilth/io/pcap_writer.hpp>
#include <tilth/sensor/packet_encoder.hpp>
#include <tilth/simulation/simulator.hpp>
#include <tilth/sources/open_source.hpp>

namespace tilth {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr UdpRoute kRoute{0xC0A801C8, 0xC0A80166, 2368, 2368};

Simulator simulator(const std::string& sensor, const std::string& beams = "ideal") {
  const std::string duration = sensor == "hdl64_s3" ? "1.8" : "1.3";  // its packets tell its calibration in 1.5 s
  const OptionValues values{
      {"sensor", sensor}, {"duration", duration}, {"speed", "2"}, {"seed", "5"}, {"beams", beams}};
  return {"corridor", simulation_options("corridor", values)};
}

/// Of sensors that tell the date scans are later by this: before 2015 it is taken for a clock that runs free.
double later(const Simulator& simulator) {
  const std::string& name = simulator.lidar().name;
  return name.starts_with("hesai") || name.starts_with("robosense") || name.starts_with("os1") ? 1.7e9 : 0.0;
}

void write_packets(const Simulator& simulator, const std::filesystem::path& path) {
  PacketStream stream(simulator.lidar());
  const SentFile about = stream.sensor_file();
  if (!about.extension.empty()) write_text(std::filesystem::path(path).replace_extension(about.extension), about.text);
  PcapWriter file(path);
  for (std::size_t i = 0; i < simulator.size(); ++i) {
    Scan scan = simulator.scan(i).scan;
    scan.stamp += later(simulator);
    for (const EncodedPacket& packet : stream.encode(scan)) file.write(packet.sent, kRoute, packet.payload);
  }
  file.close();
}

/// Lasers that fire together may stand in any order.
std::vector<std::uint32_t> by_time_and_ring(const PointCloud& cloud) {
  std::vector<std::uint32_t> order(cloud.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(cloud.times[a], cloud.rings[a]) < std::pair(cloud.times[b], cloud.rings[b]);
  });
  return order;
}

struct Shot {
  double range;
  Eigen::Vector3d direction;
};

/// As the sensor saw it: from the optical centre.
Shot shot_of(const LidarModel& lidar, const Eigen::Vector3d& point, double since_turn) {
  const Eigen::Vector3d ray = point - lidar.origin(since_turn);
  return {ray.norm(), ray.normalized()};
}

void expect_equal(const Simulator& made, Scan expected, Scan read) {
  expected.stamp += later(made);
  ASSERT_TRUE(std::is_sorted(read.cloud.times.begin(), read.cloud.times.end()));
  expected.cloud = select(expected.cloud, by_time_and_ring(expected.cloud));
  read.cloud = select(read.cloud, by_time_and_ring(read.cloud));
  ASSERT_EQ(read.cloud.rings, expected.cloud.rings);
  EXPECT_EQ(read.cloud.intensities, expected.cloud.intensities);
  for (std::size_t i = 0; i < expected.cloud.size(); ++i) {
    const double time = expected.cloud.times[i];
    ASSERT_NEAR(read.stamp + read.cloud.times[i], expected.stamp + time, 1.6e-6) << "point " << i;
    const Shot a = shot_of(made.lidar(), expected.cloud.points[i], time);
    const Shot b = shot_of(made.lidar(), read.cloud.points[i], time);
    ASSERT_NEAR(a.range, b.range, 0.5 * made.lidar().range_step + 1e-5) << "point " << i;
    ASSERT_LT((a.direction - b.direction).norm(), 0.0102 * kDegree) << "point " << i;
  }
}

TEST(PacketRoundTrip, GivesTheSimulatedScansWithinTheirQuantisation) {
  for (const std::string sensor :
       {"vlp16", "leishen_c16", "hdl32", "vlp32c", "vls128", "hdl64_s2", "hdl64_s3", "os1_64"}) {
    SCOPED_TRACE(sensor);
    const TemporaryFolder folder;
    const Simulator made = simulator(sensor);
    write_packets(made, folder / "scans.pcap");
    SourceOptions options;
    if (std::filesystem::exists(folder / "scans.csv")) options.values["sensor_file"] = (folder / "scans.csv").string();
    const auto source = open_source((folder / "scans.pcap").string(), options);
    const std::string name = sensor == "os1_64" ? "(ouster)" : "(" + sensor;
    EXPECT_NE(source->decisions().at(1).find(name), std::string::npos) << source->decisions().at(1);
    std::size_t i = 0;
    for (; const auto scan = source->next(); ++i) expect_equal(made, made.scan(i).scan, *scan);
    EXPECT_EQ(i, made.size());
    for (const std::string& notice : source->notices()) {
      EXPECT_TRUE(notice.starts_with("packets: ")) << notice;
    }
  }
}

TEST(PacketRoundTrip, CarriesTheErrorsOfBeams) {
  const TemporaryFolder folder;
  const Simulator worn = simulator("vlp16", "worn"), ideal = simulator("vlp16");
  write_packets(worn, folder / "scans.pcap");
  const auto source = open_source((folder / "scans.pcap").string(), {});
  std::size_t i = 0;
  for (; const auto scan = source->next(); ++i) {
    EXPECT_NE(worn.scan(i).scan.cloud.points, ideal.scan(i).scan.cloud.points);
    expect_equal(worn, worn.scan(i).scan, *scan);
  }
  EXPECT_EQ(i, worn.size());
}

TEST(PacketRoundTrip, RingsOfSimulatedPacketsLieAtThePublishedAngles) {
  const TemporaryFolder folder;
  write_packets(simulator("vlp16"), folder / "scans.pcap");
  const auto source = open_source((folder / "scans.pcap").string() + "?sensor=vlp16", {});
  std::array<std::size_t, 16> seen{};
  while (const auto scan = source->next()) {
    for (std::size_t i = 0; i < scan->cloud.size(); ++i) {
      const Eigen::Vector3d& p = scan->cloud.points[i];
      const std::size_t ring = scan->cloud.rings[i];
      ASSERT_NEAR(std::atan2(p.z(), p.head<2>().norm()) / kDegree, -15.0 + 2.0 * double(ring), 1e-9);
      ++seen.at(ring);
    }
  }
  for (const std::size_t count : seen) EXPECT_GT(count, 1000U);
}

TEST(PacketRoundTrip, SensorsOfTwoMakersAreToldApartByTheirAddress) {
  const TemporaryFolder folder;
  const Simulator ouster = simulator("os1_64"), puck = simulator("vlp16");
  PacketStream ousters(ouster.lidar()), pucks(puck.lidar());
  write_text(folder / "both.json", ousters.sensor_file().text);
  PcapWriter file(folder / "both.pcap");
  for (std::size_t i = 0; i < ouster.size(); ++i) {
    for (const EncodedPacket& packet : ousters.encode(ouster.scan(i).scan))
      file.write(packet.sent, {0x0A000001, 0x0A0000FF, 7502, 7502}, packet.payload);
    for (const EncodedPacket& packet : pucks.encode(puck.scan(i).scan))
      file.write(packet.sent, {0x0A000002, 0x0A0000FF, 2368, 2368}, packet.payload);
  }
  file.close();
  for (const auto& [host, name, rings] : {std::tuple{"10.0.0.1", "(ouster)", 64U}, {"10.0.0.2", "(vlp16)", 16U}}) {
    const auto source = open_source((folder / "both.pcap").string() + "?host=" + host, {});
    EXPECT_NE(source->decisions().at(1).find(name), std::string::npos) << source->decisions().at(1);
    std::size_t scans = 0;
    for (; const auto scan = source->next(); ++scans) {
      for (const std::uint16_t ring : scan->cloud.rings) ASSERT_LT(ring, rings);
    }
    EXPECT_EQ(scans, ouster.size()) << host;
  }
}

TEST(PacketRoundTrip, WhatPacketsCannotHoldIsRefused) {
  Scan snapshot = simulator("vlp16").scan(0).scan;
  const PacketFormat format = packet_format_of(vlp16());
  EXPECT_NO_THROW(encode_scan(snapshot, vlp16(), format));
  snapshot.cloud.times[7] += 20e-6F;
  EXPECT_THROW(encode_scan(snapshot, vlp16(), format), Error) << "between two firings";
  snapshot.cloud.times.clear();
  EXPECT_THROW(encode_scan(snapshot, vlp16(), format), Error);
  EXPECT_THROW(packet_format_of(hdl64()), Error);
  EXPECT_THROW(packet_format_of(with_columns(vlp16(), 100)), Error);
}

}  // namespace
}  // namespace tilth
