// Packets of RoboSense's RS-LiDAR-16, RS-LiDAR-32, RS-Helios and RS-Helios-16P, put together byte by byte (big-endian).
#include <cmath>
#include <sensor/made_packets.hpp>

#include <gtest/gtest.h>

#include <tilth/core/error.hpp>
#include <tilth/sensor/block_decoder.hpp>

namespace tilth {
namespace {

constexpr double k2024 = 1704067200.0;  // [s] 2024-01-01T00:00:00Z
constexpr std::size_t kSize = 1248;

struct RobosenseSensor {
  std::size_t lasers;
  bool helios;
  double firing, unit, radius;  // [s] [m] [m]

  double block() const { return lasers == 16 ? 2 * firing : firing; }

  std::vector<std::byte> packet(std::size_t k, bool dual = false) const {
    MadePacket made(kSize);
    const std::vector<unsigned> old{0x55, 0xAA, 0x05, 0x0A, 0x5A, 0xA5, 0x50, 0xA0}, now{0x55, 0xAA, 0x05, 0x5A};
    const std::vector<unsigned>& begin = helios ? now : old;
    for (std::size_t i = 0; i < begin.size(); ++i) made.byte(i, begin[i]);
    const std::size_t columns = dual ? 6 : 12;
    const auto us = std::uint32_t(std::lround((0.002 + double(k * columns) * block()) * 1e6));
    if (helios) {
      made.big(20, 0, 2), made.big(22, std::uint32_t(k2024), 4), made.big(26, us, 4);
    } else {
      made.byte(20, 24), made.byte(21, 1), made.byte(22, 1);
      made.big(26, us / 1000, 2), made.big(28, us % 1000, 2);
      made.byte(30, lasers == 16 ? 1 : 2);
    }
    for (std::size_t b = 0; b < 12; ++b) {
      const std::size_t at = 42 + 100 * b, column = k * columns + (dual ? b / 2 : b);
      made.byte(at, 0xFF), made.byte(at + 1, 0xEE);
      made.big(at + 2, unsigned(std::lround(360000.0 * block() * double(column))) % 36000, 2);
      for (std::size_t slot = 0; slot < 32; ++slot) {
        made.big(at + 4 + 3 * slot, std::uint32_t(2000 + 10 * slot + (dual ? 4 * (b % 2) : 0)), 2);
        made.byte(at + 6 + 3 * slot, unsigned(slot));
      }
    }
    return made.bytes();
  }

  std::vector<std::vector<std::byte>> turn(bool dual = false) const {
    std::vector<std::vector<std::byte>> all;
    for (std::size_t k = 0; double(k * (dual ? 6 : 12)) * block() < 0.102; ++k) all.push_back(packet(k, dual));
    return all;
  }
};

/// Lasers at 15.1, 14.1 ... degrees, 2 degrees ahead and behind in turns; of an RS-LiDAR-16 half a degree off the
/// table.
std::vector<std::byte> told_angles(const RobosenseSensor& sensor, unsigned mode = 4) {
  MadePacket made(kSize);
  const std::array<unsigned, 8> magic{0xA5, 0xFF, 0x00, 0x5A, 0x11, 0x11, 0x55, 0x55};
  for (std::size_t i = 0; i < magic.size(); ++i) made.byte(i, magic[i]);
  made.big(8, 600, 2), made.byte(300, mode);
  if (sensor.lasers == 16 && !sensor.helios) {
    for (std::size_t i = 0; i < 16; ++i)
      made.big(1165 + 3 * i, std::uint32_t(i < 8 ? 155000 - 20000 * i : 145000 - 20000 * (i - 8)), 3);
    return made.bytes();
  }
  for (std::size_t i = 0; i < sensor.lasers; ++i) {
    const int elevation = 1510 - 100 * int(i);
    made.byte(468 + 3 * i, elevation < 0 ? 1 : 0), made.big(469 + 3 * i, unsigned(std::abs(elevation)), 2);
    made.byte(564 + 3 * i, unsigned(i % 2)), made.big(565 + 3 * i, 200, 2);
  }
  return made.bytes();
}

struct Decoded {
  std::string name;
  Scan scan;
};

Decoded decoded(std::vector<std::vector<std::byte>> payloads, const std::vector<std::vector<std::byte>>& about) {
  payloads.insert(payloads.begin(), about.begin(), about.end());
  const std::vector<Packet> packets = packets_of(payloads);
  BlockDecoder decoder(packets, {});
  for (const Packet& packet : packets) {
    if (auto scan = decoder.decode(packet)) return {decoder.format().name, *scan};
  }
  throw std::runtime_error("no scan");
}

void expect_shot(const RobosenseSensor& sensor, const Scan& scan, std::size_t ring, const Eigen::Vector3d& expected,
                 double time) {
  for (std::size_t i = 0; i < scan.cloud.size(); ++i) {
    if (scan.cloud.rings[i] != ring) continue;
    EXPECT_NEAR(scan.stamp + scan.cloud.times[i], k2024 + 0.002 + time, 1.1e-6);
    EXPECT_LT((scan.cloud.points[i] - expected).norm(), 0.011 * kDeg * expected.norm()) << sensor.lasers;
    return;
  }
  FAIL() << "no shot of ring " << ring;
}

/// [m] of a laser that points that way [deg], `time` [s] after the head stood at 0.
Eigen::Vector3d place(const RobosenseSensor& sensor, double range, double elevation, double ahead, double time) {
  const double head = 3600.0 * time * kDeg, azimuth = head + ahead * kDeg, level = range * std::cos(elevation * kDeg);
  return {level * std::cos(azimuth) + sensor.radius * std::cos(head),
          -level * std::sin(azimuth) - sensor.radius * std::sin(head), range * std::sin(elevation * kDeg)};
}

TEST(RobosensePackets, AnRs16HasATableAndBelievesItsDevicePackets) {
  const RobosenseSensor sensor{16, false, 55.5e-6, 0.005, 0.03825};
  const Decoded table = decoded(sensor.turn(), {});
  EXPECT_EQ(table.name, "robosense_rs16");
  EXPECT_NEAR(table.scan.stamp, k2024 + 0.002, 1e-6);
  expect_shot(sensor, table.scan, 0, place(sensor, 10.0, -15.0, 0.0, 0.0), 0.0);
  expect_shot(sensor, table.scan, 15, place(sensor, 10.4, 15.0, 0.0, 8 * 2.8e-6), 8 * 2.8e-6);
  const Decoded told = decoded(sensor.turn(), {told_angles(sensor)});
  expect_shot(sensor, told.scan, 0, place(sensor, 10.0, -15.5, 0.0, 0.0), 0.0);
  expect_shot(sensor, told.scan, 15, place(sensor, 10.4, 14.5, 0.0, 8 * 2.8e-6), 8 * 2.8e-6);
  EXPECT_THROW(decoded(sensor.turn(), {told_angles(sensor, 0)}), Error) << "two returns a shot of 16 lasers";
}

TEST(RobosensePackets, OthersTellTheirAngles) {
  for (const auto& [sensor, name, last] :
       {std::tuple{RobosenseSensor{32, false, 55.52e-6, 0.005, 0.03997}, "robosense_rs32", 46.08e-6},
        {RobosenseSensor{32, true, 55.56e-6, 0.0025, 0.03498}, "robosense_helios", 45.15e-6},
        {RobosenseSensor{16, true, 55.56e-6, 0.0025, 0.03498}, "robosense_helios_16p", 43.91e-6}}) {
    SCOPED_TRACE(name);
    EXPECT_THROW(decoded(sensor.turn(), {}), Error) << "no angles";
    const Decoded all = decoded(sensor.turn(), {told_angles(sensor)});
    EXPECT_EQ(all.name, name);
    const std::size_t end = sensor.lasers - 1;
    expect_shot(sensor, all.scan, end, place(sensor, sensor.unit * 2000, 15.1, 2.0, 0.0), 0.0);
    expect_shot(sensor, all.scan, 0,
                place(sensor, sensor.unit * double(2000 + 10 * end), 15.1 - double(end), -2.0, last), last);
  }
}

TEST(RobosensePackets, TwoEchoesOf32LasersStandInTwoBlocks) {
  const RobosenseSensor sensor{32, true, 55.56e-6, 0.0025, 0.03498};
  const Scan scan = decoded(sensor.turn(true), {told_angles(sensor, 0)}).scan;
  ASSERT_EQ(scan.cloud.size() % 64, 0U);
  EXPECT_EQ(scan.cloud.times[0], scan.cloud.times[1]);
  EXPECT_NEAR(scan.cloud.times[64], 55.56e-6, 1e-8);
}

}  // namespace
}  // namespace tilth
