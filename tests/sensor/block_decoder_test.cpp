// Velodyne packets made byte by byte: angles, times, echoes, cuts, and what is lost.
#include <algorithm>
#include <cmath>
#include <sensor/made_packets.hpp>

#include <gtest/gtest.h>

#include "sensor/decoded_scans.hpp"
#include <tilth/core/error.hpp>
#include <tilth/sensor/block_decoder.hpp>

namespace tilth {
namespace {

std::vector<Scan> decoded(const std::vector<Packet>& packets, const PacketOptions& options = {},
                          PacketCounts* counts = nullptr) {
  BlockDecoder decoder(packets, options);
  return scans_of(decoder, packets, counts);
}

/// [0.01 deg], clockwise from x, of the ray from the axis.
double azimuth_of(const Eigen::Vector3d& p) {
  const double angle = -std::atan2(p.y(), p.x()) / kDeg * 100.0;
  return angle < 0.0 ? angle + 36000.0 : angle;
}

TEST(BlockDecoder, PlacesEveryShotOfAVlp16) {
  MadeSensor sensor;
  sensor.echo = [](std::size_t block, std::size_t slot) {
    return Echo{std::uint16_t(1000 + 100 * block + slot), std::uint8_t(slot)};
  };
  const auto payloads = sensor.packets(76);  // 0 to 362.98 degrees
  const std::vector<Scan> scans = decoded(packets_of(payloads));
  ASSERT_EQ(scans.size(), 1U);
  const Scan& scan = scans.front();
  const std::array<double, 16> degrees{-15, 1, -13, 3, -11, 5, -9, 7, -7, 9, -5, 11, -3, 13, -1, 15};
  ASSERT_EQ(scan.cloud.size() % 32, 0U);
  ASSERT_NEAR(scan.stamp, 100.0, 1e-9);
  for (std::size_t i = 0; i < scan.cloud.size(); ++i) {
    const std::size_t block = i / 32, slot = i % 32;
    const double time = 110.592e-6 * double(block) + 55.296e-6 * double(slot / 16) + 2.304e-6 * double(slot % 16);
    ASSERT_NEAR(scan.cloud.times[i], time, 1e-6);
    const Eigen::Vector3d& p = scan.cloud.points[i];
    ASSERT_NEAR(p.norm(), 0.002 * double(1000 + 100 * (block % 12) + slot), 1e-9);
    ASSERT_NEAR(std::asin(p.z() / p.norm()) / kDeg, degrees[slot % 16], 1e-9);
    ASSERT_EQ(scan.cloud.rings[i], std::lround((degrees[slot % 16] + 15) / 2));
    ASSERT_EQ(scan.cloud.intensities[i], float(slot));
    ASSERT_NEAR(std::remainder(azimuth_of(p) - 39.8 * time / 110.592e-6, 36000.0), 0.0, 1.01) << i;
  }
}

TEST(BlockDecoder, FiresAll32LasersOfAnHdl32InOneBlock) {
  MadeSensor sensor;
  sensor.model = 0x21, sensor.period = 46.08e-6, sensor.step = 16.6;
  const auto payloads = sensor.packets(185);
  const std::vector<Scan> scans = decoded(packets_of(payloads));
  ASSERT_EQ(scans.size(), 1U);
  const PointCloud& cloud = scans.front().cloud;
  EXPECT_NEAR(std::asin(cloud.points[0].z() / 10.0) / kDeg, -30.667, 1e-3);
  EXPECT_NEAR(std::asin(cloud.points[1].z() / 10.0) / kDeg, -9.333, 1e-3);
  EXPECT_NEAR(std::asin(cloud.points[31].z() / 10.0) / kDeg, 10.667, 1e-3);
  EXPECT_NEAR(cloud.times[31], 31 * 1.152e-6, 1e-9);
  EXPECT_NEAR(cloud.times[32], 46.08e-6, 1e-9);
  EXPECT_EQ(cloud.rings[31], 31);
  EXPECT_EQ(cloud.rings[1], 16);
}

TEST(BlockDecoder, TellsTheVlp16FromTheHdl32ByItsClockWhereBothSayTheSame) {
  MadeSensor sensor;
  sensor.model = 0x21;
  const auto payloads = sensor.packets(5);
  EXPECT_EQ(BlockDecoder(packets_of(payloads), {}).format().name, "vlp16");
}

TEST(BlockDecoder, EchoesOfAShotShareItsTime) {
  MadeSensor sensor;
  sensor.mode = 0x39;
  sensor.echo = [](std::size_t block, std::size_t slot) {
    if (slot == 3) return Echo{4000, 50};  // both blocks the same
    return block % 2 == 0 ? Echo{6000, 10} : Echo{std::uint16_t(slot == 5 ? 0 : 5000), 90};
  };
  const auto payloads = sensor.packets(151);
  const std::vector<Packet> packets = packets_of(payloads);
  const std::vector<Scan> both = decoded(packets);
  ASSERT_EQ(both.size(), 1U);
  const PointCloud& cloud = both.front().cloud;
  ASSERT_TRUE(std::is_sorted(cloud.times.begin(), cloud.times.end()));
  const std::size_t a_column = 32 + 32 - 2;  // slots 3 and 5 have one echo each
  ASSERT_EQ(cloud.size() % a_column, 0U);
  EXPECT_NEAR(cloud.times[a_column], 110.592e-6, 1e-8);
  EXPECT_EQ(cloud.times[0], cloud.times[1]);
  EXPECT_NEAR(cloud.points[0].norm(), 12.0, 1e-9);
  EXPECT_NEAR(cloud.points[1].norm(), 10.0, 1e-9);
  EXPECT_NEAR(cloud.times[a_column * 6], 6 * 110.592e-6, 1.1e-6) << "the next packet";
  EXPECT_NEAR(azimuth_of(cloud.points[a_column]), 39.8, 0.51);

  const Scan strongest = decoded(packets, {"", Echoes::strongest}).front();
  EXPECT_EQ(strongest.cloud.size() % 32, 0U);
  EXPECT_NEAR(strongest.cloud.points[0].norm(), 10.0, 1e-9);
  EXPECT_NEAR(decoded(packets, {"", Echoes::farthest}).front().cloud.points[0].norm(), 12.0, 1e-9);
}

TEST(BlockDecoder, LostPacketsAreCountedAndShiftNoTimes) {
  const MadeSensor sensor;
  const auto payloads = sensor.packets(2 * 76);
  std::vector<Packet> packets = packets_of(payloads);
  PacketCounts counts;
  const std::vector<Scan> whole = decoded(packets, {}, &counts);
  EXPECT_EQ(counts.lost, 0U);
  packets.erase(packets.begin() + 30, packets.begin() + 40);
  packets.erase(packets.begin() + 5);
  const std::vector<Scan> holed = decoded(packets, {}, &counts);
  EXPECT_EQ(counts.lost, 11U);
  ASSERT_EQ(holed.size(), whole.size());
  EXPECT_EQ(holed[0].cloud.size() + 11U * 384U, whole[0].cloud.size());
  EXPECT_EQ(holed[0].cloud.points.back(), whole[0].cloud.points.back());
  EXPECT_EQ(holed[0].cloud.times.back(), whole[0].cloud.times.back());
  EXPECT_EQ(holed[1].stamp, whole[1].stamp);
}

TEST(BlockDecoder, ATurnIsCutWhereItsBeginWasLost) {
  MadeSensor sensor;
  const auto payloads = sensor.packets(4 * 76);
  std::vector<Packet> packets = packets_of(payloads);
  packets.erase(packets.begin() + 40, packets.begin() + 40 + 76 + 5);  // more than a turn: no wrap can be seen
  PacketCounts counts;
  const std::vector<Scan> scans = decoded(packets, {}, &counts);
  EXPECT_EQ(counts.lost, 81U);
  for (const Scan& scan : scans) EXPECT_LT(scan.cloud.times.back(), 0.101F);
}

TEST(BlockDecoder, LateAndRepeatedPacketsAreLeftOut) {
  const MadeSensor sensor;
  const auto payloads = sensor.packets(76);
  std::vector<Packet> packets = packets_of(payloads);
  const Scan whole = decoded(packets).front();
  packets.insert(packets.begin() + 20, packets[20]);
  packets.insert(packets.begin() + 30, packets[10]);
  PacketCounts counts;
  EXPECT_EQ(decoded(packets, {}, &counts).front().cloud.points, whole.cloud.points);
  EXPECT_EQ(counts.late, 2U);
}

TEST(BlockDecoder, TurnsBegunBeforeTheFirstPacketCountFromHalfOn) {
  MadeSensor sensor;
  for (const auto& [begin, scans, incomplete] : {std::tuple{17000.0, 2U, 0U}, std::tuple{19000.0, 1U, 1U}}) {
    sensor.begin = begin;
    const double blocks = (2 * 36000.0 - begin) / sensor.step;
    const auto payloads = sensor.packets(std::size_t(blocks / 12.0) + 2);
    PacketCounts counts;
    EXPECT_EQ(decoded(packets_of(payloads), {}, &counts).size(), scans) << begin;
    EXPECT_EQ(counts.incomplete, incomplete + 1U) << "the last packet begins a turn";
  }
}

TEST(BlockDecoder, AHeadThatDoesNotTurnGivesNoScansAndFillsNoMemory) {
  MadeSensor sensor;
  sensor.step = 0.0;
  const auto payloads = sensor.packets(3000);
  EXPECT_TRUE(decoded(packets_of(payloads)).empty());
}

TEST(BlockDecoder, RefusesWhatNoSensorSends) {
  MadeSensor sensor;
  sensor.model = 0x20;
  const auto payloads = sensor.packets(3);
  const std::vector<Packet> packets = packets_of(payloads);
  EXPECT_THROW(BlockDecoder(packets, {}), Error) << "a Leishen C32";
  EXPECT_NO_THROW(BlockDecoder(packets, {"vlp16", Echoes::both}));
  EXPECT_THROW(BlockDecoder(packets, {"vlp17", Echoes::both}), Error);
  EXPECT_THROW(BlockDecoder(packets, {"leishen_c16_v4", Echoes::both}), Error) << "those have 1212 bytes";
  EXPECT_THROW(BlockDecoder({}, {}), Error);
}

}  // namespace
}  // namespace tilth
