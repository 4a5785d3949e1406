// Leishen C16 packets of every generation made byte by byte: angles, units, optical centre, times, device packets.
#include <algorithm>
#include <cmath>
#include <sensor/made_packets.hpp>

#include <gtest/gtest.h>

#include <tilth/core/error.hpp>
#include <tilth/sensor/block_decoder.hpp>
#include <tilth/sensor/device_packet.hpp>

namespace tilth {
namespace {

MadeSensor c16(std::size_t size, unsigned model) {
  MadeSensor sensor;
  sensor.size = size, sensor.model = model, sensor.period = 100e-6, sensor.step = 36.0, sensor.clock = 0.2;
  return sensor;
}

/// The 1212-byte tail: 2026-03-04 05:06:07 and a fraction.
void set_date(MadePacket& packet, std::uint32_t fraction) {
  const std::array<unsigned, 6> date{26, 3, 4, 5, 6, 7};
  for (std::size_t i = 0; i < date.size(); ++i) packet.byte(1200 + i, date[i]);
  packet.little(1206, fraction, 4);
}

struct Generation {
  const char* name;
  std::size_t size;
  unsigned model;
  double unit, radius, angle;  // [m] [m] [deg]
  std::array<double, 16> degrees;
};

const std::array<double, 16> kTwoDegrees{-15, 1, -13, 3, -11, 5, -9, 7, -7, 9, -5, 11, -3, 13, -1, 15};
const std::array<double, 16> kNarrow{-10,    .665, -8.665, 2,    -7.33, 3.33,  -6,    4.665,
                                     -4.665, 6,    -3.33,  7.33, -2,    8.665, -.665, 10};
const Generation kGenerations[] = {
    {"leishen_c16_v1", 1206, 0x10, 0.01, 0, 0, kTwoDegrees},
    {"leishen_c16_v2", 1206, 0x10, 0.0025, 0.04319, 14.68, kTwoDegrees},
    {"leishen_c16_v3", 1206, 0x10, 0.0025, 0.0431, 14.68, kTwoDegrees},
    {"leishen_c16_v2_narrow", 1206, 0x10, 0.0025, 0.04319, 14.68, kNarrow},
    {"leishen_c16_v3_narrow", 1206, 0x10, 0.0025, 0.0431, 14.68, kNarrow},
    {"leishen_c16_v4",
     1212,
     0x10,
     0.004,
     0.0361,
     20.25,
     {-16, 0, -14, 2, -12, 4, -10, 6, -8, 8, -6, 10, -4, 12, -2, 14}},
    {"leishen_c16_v4_domestic",
     1212,
     0x12,
     0.004,
     0.0361,
     20.25,
     {-16, -8, 0, 8, -14, -6, 2, 10, -12, -4, 4, 12, -10, -2, 6, 14}},
    {"leishen_c16_v5",
     1212,
     0x65,
     0.004,
     0.035,
     21.80,
     {-16, 0, -8, 8, -14, 2, -6, 10, -12, 4, -4, 12, -10, 6, -2, 14}},
};

TEST(LeishenPackets, EveryGenerationPutsItsPointsWhereItsDriverDoes) {
  for (const Generation& g : kGenerations) {
    SCOPED_TRACE(g.name);
    const MadeSensor sensor = c16(g.size, g.model);
    std::vector<std::vector<std::byte>> payloads;
    for (std::uint32_t k = 0; k < 84; ++k) {
      MadePacket packet = sensor.packet(k);
      if (g.size == 1212) set_date(packet, 200'000 + k * 1200);
      payloads.push_back(packet.bytes());
    }
    const std::vector<Packet> packets = packets_of(payloads);
    BlockDecoder decoder(packets, {g.name, Echoes::both});
    std::optional<Scan> scan;
    for (const Packet& packet : packets) {
      if (auto closed = decoder.decode(packet)) scan = std::move(closed);
    }
    ASSERT_TRUE(scan);
    std::array<double, 16> sorted = g.degrees;
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t i = 0; i < 32U * 100U; ++i) {
      const double a = (36.0 * double(i / 32) + 36.0 * double(i % 32) / 32.0) / 100.0 * kDeg;
      const double w = g.degrees[i % 16] * kDeg, r = 5000 * g.unit, behind = a - g.angle * kDeg;
      const double x = r * std::cos(w) * std::sin(a) + g.radius * std::sin(behind);  // the maker's axes: y forward
      const double y = r * std::cos(w) * std::cos(a) + g.radius * std::cos(behind);
      ASSERT_NEAR((scan->cloud.points[i] - Eigen::Vector3d(y, -x, r * std::sin(w))).norm(), 0.0, 1e-9) << i;
      ASSERT_NEAR(scan->cloud.times[i], 3.125e-6 * double(i), 1.1e-6);
      ASSERT_DOUBLE_EQ(sorted[scan->cloud.rings[i]], g.degrees[i % 16]);
    }
  }
}

TEST(LeishenPackets, ThePacketsTimeIsThatOfItsLastShot) {
  MadeSensor sensor = c16(1206, 0x10);
  const auto single = sensor.packets(84);
  BlockDecoder decoder(packets_of(single), {});
  std::optional<Scan> scan;
  for (const Packet& packet : packets_of(single)) {
    if (auto closed = decoder.decode(packet)) scan = std::move(closed);
  }
  ASSERT_TRUE(scan);
  EXPECT_NEAR(scan->stamp, 0.2 - 383 * 3.125e-6, 1e-9);

  sensor.mode = 0x39;
  const auto dual = sensor.packets(167);
  BlockDecoder dual_decoder(packets_of(dual), {});
  for (const Packet& packet : packets_of(dual)) {
    if (auto closed = dual_decoder.decode(packet)) scan = std::move(closed);
  }
  EXPECT_NEAR(scan->stamp, 0.2 - 191 * 3.125e-6, 1e-9);
  EXPECT_NEAR(scan->cloud.times[191], 191 * 3.125e-6, 1e-8) << "equal echoes are one point";
}

TEST(LeishenPackets, DatesAndFractionsOfTheLongPackets) {
  constexpr double kUtc = 1772600767.0;  // 2026-03-04 05:06:07
  for (const auto& [unit, step] : {std::pair{1e-6, 1200U}, std::pair{1e-9, 1'200'000U}}) {
    std::vector<std::vector<std::byte>> payloads;
    for (std::uint32_t k = 0; k < 84; ++k) {
      MadePacket packet = c16(1212, 0x10).packet(k);
      set_date(packet, 500'000U * std::uint32_t(1e-6 / unit + 0.5) + k * step);
      payloads.push_back(packet.bytes());
    }
    BlockDecoder decoder(packets_of(payloads), {});
    EXPECT_EQ(decoder.format().name, "leishen_c16_v4");
    std::optional<Scan> scan;
    for (const Packet& packet : packets_of(payloads)) {
      if (auto closed = decoder.decode(packet)) scan = std::move(closed);
    }
    ASSERT_TRUE(scan);
    EXPECT_NEAR(scan->stamp, kUtc + 0.5 - 383 * 3.125e-6, 1e-6);
    EXPECT_NEAR(scan->cloud.times.back(), 0.1, 1e-4);
  }
}

TEST(LeishenPackets, SecondsOfPtpAreReadAsANumber) {
  std::vector<std::vector<std::byte>> payloads;
  for (std::uint32_t k = 0; k < 84; ++k) {
    MadePacket packet = c16(1212, 0x65).packet(k);
    packet.little(1200, 0, 2);
    packet.big(1202, 1'772'600'767U, 4);
    packet.little(1206, 200'000'000U + k * 1'200'000U, 4);
    payloads.push_back(packet.bytes());
  }
  BlockDecoder decoder(packets_of(payloads), {});
  EXPECT_EQ(decoder.format().name, "leishen_c16_v5");
  std::optional<Scan> scan;
  for (const Packet& packet : packets_of(payloads)) {
    if (auto closed = decoder.decode(packet)) scan = std::move(closed);
  }
  ASSERT_TRUE(scan);
  EXPECT_NEAR(scan->stamp, 1772600767.2 - 383 * 3.125e-6, 1e-6);
}

std::string recognised(const MadeSensor& sensor, const std::optional<MadePacket>& device) {
  auto payloads = sensor.packets(4);
  if (device) payloads.push_back(MadePacket(*device).bytes());
  return BlockDecoder(packets_of(payloads), {}).format().name;
}

TEST(LeishenPackets, GenerationsAreToldByLengthModelAndDevicePacket) {
  MadePacket v2 = device_packet(), v3 = device_packet(), narrow = device_packet(), first = device_packet();
  v2.byte(1202, 2);
  v3.byte(1196, 3);
  narrow.byte(1196, 3);
  for (std::size_t i = 0; i < 16; ++i)
    narrow.big(245 + 2 * i, std::uint32_t(std::lround(kGenerations[3].degrees[i] * 100)) & 0xFFFF, 2);
  EXPECT_EQ(recognised(c16(1206, 0x10), std::nullopt), "leishen_c16_v3");
  EXPECT_EQ(recognised(c16(1206, 0x10), v2), "leishen_c16_v2");
  EXPECT_EQ(recognised(c16(1206, 0x10), v3), "leishen_c16_v3");
  EXPECT_EQ(recognised(c16(1206, 0x10), narrow), "leishen_c16_v3_narrow");
  EXPECT_EQ(recognised(c16(1206, 0x00), first), "leishen_c16_v1");
  EXPECT_EQ(recognised(c16(1212, 0x10), std::nullopt), "leishen_c16_v4");
  EXPECT_EQ(recognised(c16(1212, 0x12), std::nullopt), "leishen_c16_v4_domestic");
  EXPECT_EQ(recognised(c16(1212, 0x65), std::nullopt), "leishen_c16_v5");
  EXPECT_THROW(recognised(c16(1212, 0x11), std::nullopt), Error) << "an MS-C16, whose beams are not known";
  EXPECT_THROW(recognised(c16(1206, 0x00), std::nullopt), Error);
}

TEST(LeishenPackets, ShortPacketsPaddedByADriverStayShort) {
  auto payloads = c16(1206, 0x10).packets(4);
  for (auto& payload : payloads) payload.resize(1212);
  EXPECT_EQ(BlockDecoder(packets_of(payloads), {}).format().name, "leishen_c16_v3");
}

TEST(LeishenPackets, CalibratedAnglesCountWhereTheyLieNearTheTable) {
  MadePacket device = device_packet();
  device.byte(1196, 3);
  for (std::size_t i = 0; i < 16; ++i) {
    const int told = int(kTwoDegrees[i] * 100) + (i == 0 ? 17 : i == 1 ? 300 : -5);
    device.big(245 + 2 * i, i == 2 ? 0U : std::uint32_t(told) & 0xFFFF, 2);
  }
  auto payloads = c16(1206, 0x10).packets(4);
  payloads.push_back(device.bytes());
  const PacketFormat format = BlockDecoder(packets_of(payloads), {}).format();
  EXPECT_NEAR(format.elevations[0] / kDeg, -14.83, 1e-9);
  EXPECT_NEAR(format.elevations[1] / kDeg, 1.0, 1e-9) << "3 degrees off: not believed";
  EXPECT_NEAR(format.elevations[2] / kDeg, -13.0, 1e-9) << "never set";
  EXPECT_NEAR(format.elevations[3] / kDeg, 2.95, 1e-9);
}

TEST(LeishenPackets, DevicePacketsTellSpeedAndDate) {
  MadePacket packet = device_packet();
  packet.byte(1196, 2), packet.byte(1197, 0x80);  // v2.8
  packet.big(8, 600, 2);
  const std::array<unsigned, 6> date{26, 3, 4, 5, 6, 7};
  for (std::size_t i = 0; i < date.size(); ++i) packet.byte(52 + i, date[i]);
  const DeviceInfo info = parse_device_packet(packet.bytes());
  EXPECT_EQ(info.generation, 3);
  EXPECT_EQ(info.revolutions_per_minute, 600);
  EXPECT_EQ(info.utc, 1772600767.0);
}

}  // namespace
}  // namespace tilth
