// Packets of a Hesai PandarXT-16, put together byte by byte after its manual (sections 3.1 and B).
#include <cmath>
#include <sensor/made_packets.hpp>

#include <gtest/gtest.h>

#include <tilth/sensor/block_decoder.hpp>

namespace tilth {
namespace {

constexpr std::size_t kSize = 568, kFirstBlock = 12, kBlockSize = 66, kTail = 540;
constexpr double kFiring = 50e-6, kChannel = 3.024e-6;  // [s]
constexpr double kStep = 18.0;                          // [0.01 deg] a firing, 600 turns a minute
constexpr double k2024 = 1704067200.0;                  // [s] 2024-01-01T00:00:00Z

/// Packet `k` of a sensor whose walls are 8 m away (the second echo 12 m); `year` since 1900.
std::vector<std::byte> made(std::size_t k, bool dual, unsigned year = 124) {
  MadePacket packet(kSize);
  packet.little(0, 0xFFEE, 2), packet.byte(2, 6), packet.byte(3, 1);
  packet.byte(6, 16), packet.byte(7, 8), packet.byte(9, 4), packet.byte(10, dual ? 2 : 1), packet.byte(11, 1);
  const std::size_t firings = dual ? 4 : 8;
  for (std::size_t block = 0; block < 8; ++block) {
    const std::size_t firing = k * firings + (dual ? block / 2 : block), at = kFirstBlock + block * kBlockSize;
    packet.little(at, unsigned(std::lround(kStep * double(firing))) % 36000, 2);
    for (std::size_t slot = 0; slot < 16; ++slot) {
      packet.little(at + 2 + 4 * slot, dual && block % 2 == 1 ? 3000 : 2000, 2);
      packet.byte(at + 4 + 4 * slot, unsigned(slot));
    }
  }
  packet.byte(kTail + 10, dual ? 0x39 : 0x37), packet.little(kTail + 11, 600, 2);
  const double last_firing = kFiring * double((k + 1) * firings - 1);
  for (const auto& [at, value] : {std::pair{13U, year}, {14U, 1U}, {15U, 1U}, {16U, 0U}, {17U, 0U}, {18U, 0U}})
    packet.byte(kTail + at, value);
  packet.little(kTail + 19, std::uint32_t(std::lround(last_firing * 1e6)), 4);
  packet.byte(kTail + 23, 0x42), packet.little(kTail + 24, std::uint32_t(k + 1), 4);
  return packet.bytes();
}

struct Decoded {
  std::vector<Scan> scans;
  PacketCounts counts;
  std::vector<std::string> decisions;
};

Decoded decode(const std::vector<std::vector<std::byte>>& payloads) {
  const std::vector<Packet> packets = packets_of(payloads);
  BlockDecoder decoder(packets, {});
  Decoded all;
  for (const Packet& packet : packets) {
    if (auto scan = decoder.decode(packet)) all.scans.push_back(std::move(*scan));
  }
  all.counts = decoder.counts(), all.decisions = decoder.decisions();
  return all;
}

std::vector<std::vector<std::byte>> stream(std::size_t count, bool dual) {
  std::vector<std::vector<std::byte>> packets;
  for (std::size_t k = 0; k < count; ++k) packets.push_back(made(k, dual));
  return packets;
}

TEST(HesaiPacket, EveryShotHasItsPlaceRingAndTime) {
  const Decoded all = decode(stream(260, false));  // 250 packets a turn
  ASSERT_EQ(all.scans.size(), 1U);
  EXPECT_NE(all.decisions.front().find("(hesai_xt16)"), std::string::npos) << all.decisions.front();
  const Scan& scan = all.scans.front();
  ASSERT_EQ(scan.cloud.size(), 2000U * 16U);
  EXPECT_NEAR(scan.stamp, k2024 + 6e-6, 1e-6) << "6 us after the time of the first firing";
  for (std::size_t i = 0; i < scan.cloud.size(); ++i) {
    const std::size_t firing = i / 16, channel = i % 16;
    const double elevation = (15.0 - 2.0 * double(channel)) * kDeg;
    const double azimuth = kStep / 100 * kDeg * (double(firing) + double(channel) * kChannel / kFiring);
    const Eigen::Vector3d expected(std::cos(elevation) * std::cos(azimuth), -std::cos(elevation) * std::sin(azimuth),
                                   std::sin(elevation));
    ASSERT_LT((scan.cloud.points[i] - 8.0 * expected).norm(), 1e-6) << i;
    ASSERT_EQ(scan.cloud.rings[i], 15 - channel);
    ASSERT_EQ(scan.cloud.intensities[i], float(channel));
    ASSERT_NEAR(scan.cloud.times[i], double(firing) * kFiring + double(channel) * kChannel, 2e-6);
  }
}

TEST(HesaiPacket, BothEchoesOfAShotShareItsTime) {
  const Decoded all = decode(stream(510, true));  // 500 packets a turn
  ASSERT_EQ(all.scans.size(), 1U);
  const PointCloud& cloud = all.scans.front().cloud;
  ASSERT_EQ(cloud.size(), 2 * 2000U * 16U);
  for (std::size_t i = 0; i < cloud.size(); i += 2) {
    ASSERT_EQ(cloud.times[i], cloud.times[i + 1]);
    ASSERT_EQ(cloud.rings[i], cloud.rings[i + 1]);
    ASSERT_NEAR(cloud.points[i].norm(), 8.0, 1e-9);
    ASSERT_NEAR(cloud.points[i + 1].norm(), 12.0, 1e-9);
  }
}

TEST(HesaiPacket, LostPacketsAreCountedAndShiftNoTimes) {
  std::vector<std::vector<std::byte>> packets = stream(260, false);
  packets.erase(packets.begin() + 100, packets.begin() + 103);
  const Decoded all = decode(packets);
  ASSERT_EQ(all.scans.size(), 1U);
  EXPECT_EQ(all.counts.lost, 3U);
  EXPECT_EQ(all.scans.front().cloud.size(), (2000U - 24U) * 16U);
  EXPECT_NEAR(all.scans.front().cloud.times.back(), 1999 * kFiring + 15 * kChannel, 2e-6);
}

TEST(HesaiPacket, AClockThatWasNeverSetDoesNotTellTheDate) {
  std::vector<std::vector<std::byte>> packets;
  for (std::size_t k = 0; k < 260; ++k) packets.push_back(made(k, false, 70));
  const Decoded all = decode(packets);
  ASSERT_EQ(all.scans.size(), 1U);
  EXPECT_LT(all.scans.front().stamp, 1.0);
  EXPECT_NE(all.decisions.back().find("nothing tells the date"), std::string::npos) << all.decisions.back();
}

TEST(HesaiPacket, OtherModelsOfTheMakerAreNotTakenForIt) {
  std::vector<std::byte> packet = made(0, false);
  EXPECT_EQ(kind_of(packet), PacketKind::data);
  for (const std::size_t at : {0U, 1U, 2U, 3U, 6U, 7U, 9U}) {
    std::vector<std::byte> other = packet;
    other[at] = std::byte(0x20);
    EXPECT_EQ(kind_of(other), PacketKind::other) << at;
  }
  packet.push_back(std::byte(0));
  EXPECT_EQ(kind_of(packet), PacketKind::other);
}

}  // namespace
}  // namespace tilth
