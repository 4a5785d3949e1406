// Packets of Hesai's PandarXT-32, Pandar64, Pandar40P and PandarQT, put together byte by byte after its manuals.
#include <cmath>
#include <sensor/made_packets.hpp>

#include <gtest/gtest.h>

#include <tilth/core/error.hpp>
#include <tilth/sensor/block_decoder.hpp>

namespace tilth {
namespace {

constexpr double k2024 = 1704067200.0;  // [s] 2024-01-01T00:00:00Z

/// Where things stand in a packet, and when it is stamped.
struct HesaiSensor {
  const char* name;
  std::size_t size, header, blocks, lasers, slot, azimuth_at;
  std::size_t mode, date, fraction;
  unsigned year;
  double period, stamp;            // [s] of a firing; of the packet after the azimuth it is stamped by
  std::vector<unsigned> begin;     // of the packet
  double first_laser, last_laser;  // [s] after the azimuth of the block

  std::vector<std::byte> packet(std::size_t k, bool dual) const {
    MadePacket made(size);
    for (std::size_t i = 0; i < begin.size(); ++i) made.byte(i, begin[i]);
    const std::size_t columns = dual ? blocks / 2 : blocks, block_size = azimuth_at + 2 + lasers * slot;
    for (std::size_t block = 0; block < blocks; ++block) {
      const std::size_t at = header + block * block_size, column = k * columns + (dual ? block / 2 : block);
      if (azimuth_at > 0) made.byte(at, 0xEE), made.byte(at + 1, 0xFF);
      made.little(at + azimuth_at, unsigned(std::lround(azimuth(column))) % 36000, 2);
      for (std::size_t laser = 0; laser < lasers; ++laser) {
        const std::size_t shot = at + azimuth_at + 2 + laser * slot;
        made.little(shot, std::uint32_t(1000 + 10 * laser + (dual ? 5 * (block % 2) : 0)), 2);
        made.byte(shot + 2, unsigned(laser));
      }
    }
    made.byte(mode, dual ? 0x39 : 0x37);
    for (const auto& [i, value] : {std::pair{0U, year}, {1U, 1U}, {2U, 1U}}) made.byte(date + i, value);
    const std::size_t stamped = lasers == 64 && slot == 4 ? k * columns : (k + 1) * columns - 1;  // first or last
    made.little(fraction, std::uint32_t(std::lround((0.001 + double(stamped) * period + stamp) * 1e6)), 4);
    return made.bytes();
  }

  double azimuth(std::size_t column) const { return 36000.0 * 10.0 * period * double(column); }

  std::vector<std::vector<std::byte>> turn(bool dual) const {
    std::vector<std::vector<std::byte>> all;
    for (std::size_t k = 0; azimuth(k * blocks / (dual ? 2 : 1)) < 37000.0; ++k) all.push_back(packet(k, dual));
    return all;
  }
};

std::vector<HesaiSensor> sensors() {
  return {{"hesai_xt32",
           1080,
           12,
           8,
           32,
           4,
           0,
           1062,
           1065,
           1071,
           124,
           50e-6,
           -6e-6,
           {0xEE, 0xFF, 6, 1, 0, 0, 32, 8, 0, 4, 1, 0},
           0.0,
           31 * 1.512e-6},
          {"hesai_pandar64",
           1194,
           8,
           6,
           64,
           3,
           0,
           1186,
           1188,
           1182,
           24,
           55.56e-6,
           42.58e-6,
           {0xEE, 0xFF, 64, 6, 0, 4},
           -23.18e-6,
           -12.748e-6},
          {"hesai_pandar40p", 1262, 0, 10, 40, 3, 2, 1254, 1256, 1250, 24, 55.56e-6, 28.58e-6, {}, -42.22e-6, -3.62e-6},
          {"hesai_qt64",
           1072,
           12,
           4,
           64,
           4,
           0,
           1060,
           1062,
           1056,
           124,
           500e-6 / 3,
           -35.71e-6,
           {0xEE, 0xFF, 3, 2, 0, 0, 64, 4, 0, 4, 1, 0},
           2.31e-6,
           136.45e-6}};
}

/// Lasers from 10 degrees down, in turns 1 degree ahead and behind.
SensorFile file_of(const HesaiSensor& sensor) {
  UnitCalibration unit{"angles.csv", {}};
  for (std::size_t i = 0; i < sensor.lasers; ++i)
    unit.lasers.push_back({(10.0 - 0.5 * double(i)) * kDeg, {.azimuth = (i % 2 == 0 ? 1 : -1) * kDeg}});
  return {"angles.csv", std::nullopt, unit};
}

double azimuth_of(const Eigen::Vector3d& p) {
  return -std::atan2(p.y(), p.x()) / kDeg;
}

Scan first_scan(const std::vector<std::vector<std::byte>>& payloads, const SensorFile& file) {
  const std::vector<Packet> packets = packets_of(payloads);
  BlockDecoder decoder(packets, {}, file);
  for (const Packet& packet : packets) {
    if (auto scan = decoder.decode(packet)) return *scan;
  }
  throw std::runtime_error("no scan");
}

TEST(HesaiFamilies, EveryLaserHasItsPlaceAndTime) {
  for (const HesaiSensor& sensor : sensors()) {
    for (const bool dual : {false, true}) {
      SCOPED_TRACE(std::string(sensor.name) + (dual ? ", two echoes" : ""));
      const bool own = sensor.lasers != 32;
      const Scan scan = first_scan(sensor.turn(dual), own ? file_of(sensor) : SensorFile{});
      const std::size_t shots = sensor.lasers * (dual ? 2 : 1);
      ASSERT_EQ(scan.cloud.size() % shots, 0U);
      std::size_t found = 0;
      for (std::size_t i = 0; i < shots; ++i) {
        const std::size_t laser = sensor.lasers - 1 - scan.cloud.rings[i];
        if (laser != 0 && laser != sensor.lasers - 1) continue;
        ++found;
        const double time = laser == 0 ? sensor.first_laser : sensor.last_laser;
        const double elevation = own ? 10.0 - 0.5 * double(laser) : 15.0 - double(laser);
        const double ahead = own ? (laser % 2 == 0 ? 1.0 : -1.0) : 0.0;
        const Eigen::Vector3d& p = scan.cloud.points[i];
        const bool second = dual && p.norm() > 0.004 * double(1000 + 10 * laser) + 0.01;
        EXPECT_NEAR(p.norm(), 0.004 * double(1000 + 10 * laser + (second ? 5 : 0)), 1e-9);
        EXPECT_NEAR(std::asin(p.z() / p.norm()) / kDeg, elevation, 1e-9);
        EXPECT_NEAR(scan.stamp + scan.cloud.times[i], k2024 + 0.001 + time, 1.1e-6);
        EXPECT_NEAR(azimuth_of(p), ahead + 3600.0 * time, 0.011);
      }
      EXPECT_EQ(found, dual ? 4U : 2U);
    }
  }
}

TEST(HesaiFamilies, ANumberBehindThePacketChangesNothing) {
  for (const HesaiSensor& sensor : sensors()) {
    if (sensor.slot != 3) continue;
    auto payloads = sensor.turn(false);
    const Scan scan = first_scan(payloads, file_of(sensor));
    for (auto& payload : payloads) payload.resize(sensor.size + 4);
    EXPECT_EQ(first_scan(payloads, file_of(sensor)).cloud.points, scan.cloud.points);
  }
}

TEST(HesaiFamilies, ThoseWithAnglesOfTheirOwnAreRefusedWithoutThem) {
  for (const HesaiSensor& sensor : sensors()) {
    if (sensor.lasers == 32) continue;
    try {
      first_scan(sensor.turn(false), {});
      FAIL() << sensor.name;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("--sensor-file"), std::string::npos) << error.what();
    }
    SensorFile other = file_of(sensor);
    other.unit->lasers.pop_back();
    EXPECT_THROW(first_scan(sensor.turn(false), other), Error);
  }
}

}  // namespace
}  // namespace tilth
