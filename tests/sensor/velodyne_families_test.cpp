// Packets of Velodyne's larger sensors, put together byte by byte after their manuals.
#include <cmath>
#include <sensor/made_packets.hpp>

#include <gtest/gtest.h>

#include <tilth/core/error.hpp>
#include <tilth/sensor/block_decoder.hpp>
#include <tilth/sensor/hdl64_status.hpp>

namespace tilth {
namespace {

constexpr std::array<unsigned, 4> kBanks{0xEE, 0xDD, 0xCC, 0xBB};

/// A turning sensor whose packets hold `columns` azimuths of `banks` blocks, each twice where it reports two echoes.
struct BankedSensor {
  std::size_t banks = 1, columns = 12;
  double period = 55.296e-6, step = 19.9;  // [s] [0.01 deg] of a column
  unsigned model = 0x28, mode = 0x37;
  bool echoes_twice = false, by_bank = false;

  std::vector<std::byte> packet(std::size_t k) const {
    MadePacket made(1206);
    for (std::size_t block = 0; block < 12; ++block) {
      const std::size_t a_column = banks * (echoes_twice ? 2 : 1), column = block / a_column, in = block % a_column;
      if (column >= columns) break;
      const std::size_t bank = !echoes_twice ? in : by_bank ? in / 2 : in % banks;
      const std::size_t echo = !echoes_twice ? 0 : by_bank ? in % 2 : in / banks;
      const double azimuth = step * double(k * columns + column);
      made.block(block, unsigned(azimuth + 0.5), [&](std::size_t slot) {
        return Echo{std::uint16_t(2000 + 10 * (32 * bank + slot) + 5 * echo), std::uint8_t(slot)};
      });
      made.byte(block * 100 + 1, kBanks[bank]);
    }
    made.little(1200, std::uint32_t(1e6 + double(k * columns) * period * 1e6 + 0.5), 4);
    made.byte(1204, mode), made.byte(1205, model);
    return made.bytes();
  }

  std::vector<std::vector<std::byte>> turn() const {
    std::vector<std::vector<std::byte>> all;
    for (std::size_t k = 0; double(k * columns) * step < 37000.0; ++k) all.push_back(packet(k));
    return all;
  }
};

Scan only_scan(const std::vector<std::vector<std::byte>>& payloads, const SensorFile& file = {}) {
  const std::vector<Packet> packets = packets_of(payloads);
  BlockDecoder decoder(packets, {}, file);
  for (const Packet& packet : packets) {
    if (auto scan = decoder.decode(packet)) return *scan;
  }
  throw std::runtime_error("no scan");
}

double elevation_of(const Eigen::Vector3d& p) {
  return std::asin(p.z() / p.norm()) / kDeg;
}
double azimuth_of(const Eigen::Vector3d& p) {
  return -std::atan2(p.y(), p.x()) / kDeg;
}

TEST(Vlp32c, LasersPointAheadAndBehindAndFireInPairs) {
  const Scan scan = only_scan(BankedSensor{}.turn());
  const PointCloud& cloud = scan.cloud;
  EXPECT_EQ(cloud.size() % 32, 0U);
  for (const auto& [channel, elevation, azimuth] :
       {std::tuple{0U, -25.0, 1.4}, {1U, -1.0, -4.2}, {3U, -15.639, -1.4}, {29U, 15.0, -1.4}, {28U, -2.0, 4.2}}) {
    const Eigen::Vector3d& p = cloud.points[channel];
    EXPECT_NEAR(p.norm(), 0.004 * (2000 + 10 * channel), 1e-9);
    EXPECT_NEAR(elevation_of(p), elevation, 1e-9);
    EXPECT_NEAR(cloud.times[channel], 2.304e-6 * (channel / 2), 1e-9);
    EXPECT_NEAR(azimuth_of(p), azimuth + 0.199 * (2.304 * (channel / 2)) / 55.296, 0.006);
  }
  EXPECT_EQ(cloud.rings[0], 0);
  EXPECT_EQ(cloud.rings[29], 31);
  EXPECT_NEAR(cloud.times[32], 55.296e-6, 1e-9);
}

TEST(Vls128, FourBlocksMakeAFiring) {
  const BankedSensor sensor{4, 3, 53.3e-6, 19.2, 0xA1, 0x37, false, false};
  const Scan scan = only_scan(sensor.turn());
  const PointCloud& cloud = scan.cloud;
  ASSERT_EQ(cloud.size() % 128, 0U);
  EXPECT_NEAR(scan.stamp, 1.0 - 8.7e-6, 1e-9) << "a packet's time is that of its fourth group of lasers";
  for (const auto& [channel, elevation, azimuth, group] : {std::tuple{0U, -11.742, 6.354, 0U},
                                                           {36U, -25.0, -0.911, 4U},
                                                           {59U, 15.0, 0.911, 7U},
                                                           {64U, -5.62, 6.354, 9U},
                                                           {127U, 0.43, -6.354, 16U}}) {
    const Eigen::Vector3d& p = cloud.points[channel];
    EXPECT_NEAR(p.norm(), 0.004 * (2000 + 10 * channel), 1e-9);
    EXPECT_NEAR(elevation_of(p), elevation, 1e-9);
    EXPECT_NEAR(cloud.times[channel], 2.665e-6 * group, 1e-9);
    EXPECT_NEAR(azimuth_of(p), azimuth + 0.192 * 2.665 * group / 53.3, 0.006);
  }
}

TEST(Vls128, NewerFirmwareIsKnownByTheStepOfItsClock) {
  const auto payloads = BankedSensor{4, 3, 57.8e-6, 20.8, 0xA1, 0x37, false, false}.turn();
  EXPECT_EQ(BlockDecoder(packets_of(payloads), {}).format().name, "vls128_2020");
}

TEST(Vls128, TwoEchoesStandBesideOneAnotherAndOnePacketIsOneFiring) {
  const BankedSensor sensor{4, 1, 53.3e-6, 19.2, 0xA1, 0x39, true, true};
  const PointCloud cloud = only_scan(sensor.turn()).cloud;
  ASSERT_EQ(cloud.size() % 256, 0U);
  const std::size_t second = 256;
  for (std::size_t channel = 0; channel < 128; ++channel) {
    const Eigen::Vector3d& near = cloud.points[second + 2 * channel];
    EXPECT_NEAR(near.norm(), 0.004 * double(2000 + 10 * channel), 1e-9);
    EXPECT_NEAR(cloud.points[second + 2 * channel + 1].norm(), near.norm() + 0.02, 1e-9);
    EXPECT_EQ(cloud.times[second + 2 * channel], cloud.times[second + 2 * channel + 1]);
  }
  EXPECT_NEAR(azimuth_of(cloud.points[second + 254]), 0.19 - 6.354 + 0.19 * 16 * 2.665 / 53.3, 0.011);
}

UnitCalibration hdl64_unit() {
  UnitCalibration unit{"unit.xml", {}};
  for (int i = 0; i < 64; ++i) {
    LaserOffsets offsets;
    offsets.azimuth = 0.1 * (i % 8 - 3) * kDeg, offsets.range = 1.2 + 0.001 * i;
    offsets.horizontal = i % 2 == 0 ? 0.026 : -0.026, offsets.vertical = 0.2;
    unit.lasers.push_back({(2.0 - 0.4 * i) * kDeg, offsets});
  }
  return unit;
}

BankedSensor hdl64(bool dual) {
  return {2, dual ? 3U : 6U, 57.6e-6, 20.7, 0, 0, dual, false};
}

/// With status bytes that tell `unit`.
std::vector<std::vector<std::byte>> told(const BankedSensor& sensor, const UnitCalibration& unit) {
  const std::vector<StatusByte> bytes = hdl64_status_bytes(unit, true);
  std::vector<std::vector<std::byte>> payloads;
  for (std::size_t k = 0; k < kPacketsOfCalibration; ++k) {
    payloads.push_back(sensor.packet(k));
    const StatusByte byte = bytes[(k + 1234) % bytes.size()];
    payloads.back()[1204] = std::byte(byte.type), payloads.back()[1205] = std::byte(byte.value);
  }
  return payloads;
}

TEST(Hdl64, TellsItsOwnCalibration) {
  const UnitCalibration unit = hdl64_unit();
  const auto payloads = told(hdl64(false), unit);
  const BlockDecoder decoder(packets_of(payloads), {});
  EXPECT_EQ(decoder.format().name, "hdl64_s3") << "by 345.6 us from packet to packet";
  for (std::size_t i = 0; i < 64; ++i) {
    EXPECT_NEAR(decoder.format().elevations[i], unit.lasers[i].elevation, 0.0051 * kDeg);
    const LaserOffsets &read = decoder.format().offsets[i], &made = unit.lasers[i].offsets;
    EXPECT_NEAR(read.azimuth, made.azimuth, 0.0051 * kDeg);
    for (const auto& [a, b] : {std::pair{read.range, made.range}, {read.horizontal, made.horizontal}})
      EXPECT_NEAR(a, b, 0.0005);
  }
}

TEST(Hdl64, IsRefusedWithoutItsCalibration) {
  const auto payloads = hdl64(false).turn();
  EXPECT_THROW(only_scan(payloads), Error) << "ranges would be more than a metre wrong";
  UnitCalibration half = hdl64_unit();
  half.lasers.resize(32);
  EXPECT_THROW(only_scan(payloads, {"", std::nullopt, half}), Error);
}

TEST(Hdl64, EveryLaserHasItsPlace) {
  const UnitCalibration unit = hdl64_unit();
  for (const bool dual : {false, true}) {
    SCOPED_TRACE(dual);
    const PointCloud cloud = only_scan(hdl64(dual).turn(), {"", std::nullopt, unit}).cloud;
    const std::size_t shots = dual ? 128 : 64;
    ASSERT_EQ(cloud.size() % shots, 0U);
    for (std::size_t i = 0; i < shots; ++i) {
      const std::size_t laser = 63 - cloud.rings[i];
      const auto& [elevation, o] = unit.lasers[laser];
      const double time = 7.2e-6 * double(laser % 32 / 4) + std::array{0.0, 1.3e-6, 2.5e-6, 3.7e-6}[laser % 4];
      EXPECT_NEAR(cloud.times[i], time, 1e-9);
      const double azimuth = 0.207 * kDeg * time / 57.6e-6 + o.azimuth, second = dual && i % 2 == 1 ? 0.01 : 0.0;
      const double range = 0.002 * double(2000 + 10 * laser) + second + o.range;
      const Eigen::Vector3d ahead(std::cos(azimuth), -std::sin(azimuth), 0),
          left(std::sin(azimuth), std::cos(azimuth), 0);
      const Eigen::Vector3d up = std::cos(elevation) * Eigen::Vector3d::UnitZ() - std::sin(elevation) * ahead;
      const Eigen::Vector3d beam = std::cos(elevation) * ahead + std::sin(elevation) * Eigen::Vector3d::UnitZ();
      EXPECT_LT((cloud.points[i] - (range * beam + o.vertical * up + o.horizontal * left)).norm(), 1e-3) << laser;
    }
  }
}

TEST(Hdl64, ADamagedTableIsNotBelieved) {
  std::vector<StatusByte> bytes = hdl64_status_bytes(hdl64_unit(), true);
  ASSERT_EQ(bytes.size(), kPacketsOfCalibration);
  EXPECT_TRUE(hdl64_calibration(bytes));
  EXPECT_TRUE(hdl64_calibration(hdl64_status_bytes(hdl64_unit(), false)));
  constexpr std::size_t kElevation = 154;  // of the third laser
  bytes[kElevation].value ^= 1;
  EXPECT_FALSE(hdl64_calibration(bytes));
  bytes[kElevation].value ^= 1;
  bytes.erase(bytes.begin() + 2010);
  EXPECT_FALSE(hdl64_calibration(bytes));
}

}  // namespace
}  // namespace tilth
