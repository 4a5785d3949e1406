// Packets of an Ouster: made scans through every profile and back, turns cut and lost, metadata refused.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "sensor/decoded_scans.hpp"
#include <tilth/core/error.hpp>
#include <tilth/sensor/ouster_decoder.hpp>
#include <tilth/sensor/ouster_encoder.hpp>

namespace tilth {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

LidarModel small_ouster() {
  LidarModel lidar = os1_64();
  for (std::vector<double>* list : {&lidar.elevations, &lidar.firing_offsets}) list->resize(16);
  return with_columns(lidar, 512);
}

/// Every shot of a turn of `lidar` at ranges of 5 to 9 m.
Scan made_scan(const LidarModel& lidar, std::size_t turn) {
  Scan scan;
  scan.stamp = 1.7e9 + lidar.period * double(turn);
  for (std::size_t column = 0; column < lidar.columns; ++column) {
    for (std::size_t ring = 0; ring < lidar.rings(); ++ring) {
      const double time = lidar.time_of(column, ring);
      const double range = 5.0 + double((column * 7 + ring * 13 + turn) % 400) * 0.01;
      scan.cloud.points.push_back(lidar.origin(time) + range * lidar.direction(ring, time));
      scan.cloud.times.push_back(float(time));
      scan.cloud.rings.push_back(std::uint16_t(ring));
      scan.cloud.intensities.push_back(float((column + ring) % 256));
    }
  }
  return scan;
}

struct Made {
  SensorFile file;
  std::vector<EncodedPacket> packets;

  std::vector<Packet> all() const {
    std::vector<Packet> list;
    for (const EncodedPacket& packet : packets) list.push_back({packet.payload, packet.sent});
    return list;
  }
};

Made made_turns(OusterMetadata metadata, std::size_t turns, std::uint16_t first_frame = 0) {
  const LidarModel lidar = small_ouster();
  Made made{{"made.json", metadata, std::nullopt}, {}};
  for (std::size_t turn = 0; turn < turns; ++turn) {
    for (EncodedPacket& packet :
         encode_ouster_scan(made_scan(lidar, turn), lidar, metadata, std::uint16_t(first_frame + turn)))
      made.packets.push_back(std::move(packet));
  }
  return made;
}

OusterMetadata metadata_of(OusterProfile profile) {
  return ouster_metadata_of(small_ouster(), profile);
}

std::vector<Scan> decoded(const Made& made, const std::vector<Packet>& packets, PacketCounts* counts = nullptr) {
  OusterDecoder decoder(packets, {}, made.file);
  return scans_of(decoder, packets, counts);
}

TEST(OusterDecoder, EveryProfileGivesTheScansBackWithinItsQuantisation) {
  for (const auto& [profile, step] : {std::pair{OusterProfile::legacy, 0.001},
                                      {OusterProfile::single, 0.001},
                                      {OusterProfile::dual, 0.001},
                                      {OusterProfile::low, 0.008}}) {
    SCOPED_TRACE(name_of(profile));
    const Made made = made_turns(metadata_of(profile), 3);
    for (const EncodedPacket& packet : made.packets) ASSERT_TRUE(is_ouster_packet(packet.payload));
    PacketCounts counts;
    const std::vector<Scan> scans = decoded(made, made.all(), &counts);
    ASSERT_EQ(scans.size(), 3U);
    EXPECT_EQ(counts.lost + counts.late + counts.other + counts.incomplete, 0U);
    for (std::size_t turn = 0; turn < scans.size(); ++turn) {
      const Scan expected = made_scan(small_ouster(), turn);
      const PointCloud& cloud = scans[turn].cloud;
      ASSERT_EQ(cloud.size(), expected.cloud.size());
      EXPECT_NEAR(scans[turn].stamp, expected.stamp, 1e-6);
      for (std::size_t i = 0; i < cloud.size(); ++i) {
        const std::size_t same = i / 16 * 16 + (15 - i % 16);  // the highest beam comes first
        ASSERT_EQ(cloud.rings[i], expected.cloud.rings[same]);
        ASSERT_EQ(cloud.intensities[i], expected.cloud.intensities[same]);
        ASSERT_NEAR(cloud.times[i], expected.cloud.times[same], 1e-6);
        ASSERT_LT((cloud.points[i] - expected.cloud.points[same]).norm(), 0.5 * step + 1e-6);
      }
    }
  }
}

TEST(OusterDecoder, BeamsPointAsideAndTheSecondEchoOfTwoIsAPoint) {
  OusterMetadata metadata = metadata_of(OusterProfile::dual);
  metadata.azimuths.assign(16, 3.0 * kDegree);
  Made made = made_turns(metadata, 1);
  const std::size_t pixel = 32 + 12;  // row 0 of the first column
  made.packets[0].payload[pixel + 4] = std::byte(0x10), made.packets[0].payload[pixel + 5] = std::byte(0x27);
  made.packets[0].payload[pixel + 7] = std::byte(99);
  const PointCloud cloud = decoded(made, made.all()).at(0).cloud;
  ASSERT_EQ(cloud.size(), 512U * 16U + 1U);
  EXPECT_EQ(cloud.intensities[1], 99.0F);
  const double range = 10.0 - metadata.beam_origin.x(), up = metadata.altitudes[0];
  const Eigen::Vector3d expected(range * std::cos(up) * std::cos(3 * kDegree) + metadata.beam_origin.x(),
                                 -range * std::cos(up) * std::sin(3 * kDegree), range * std::sin(up));
  EXPECT_LT((cloud.points[1] - expected).norm(), 1e-9) << "azimuths are counted clockwise";
}

TEST(OusterDecoder, LostLateAndRepeatedPacketsAreCounted) {
  const Made made = made_turns(metadata_of(OusterProfile::single), 4, 65534);  // the number of the turn wraps
  std::vector<Packet> packets = made.all();
  packets.erase(packets.begin() + 40, packets.begin() + 45);
  packets.insert(packets.begin() + 20, packets[19]);
  packets.insert(packets.begin() + 70, packets[10]);
  PacketCounts counts;
  const std::vector<Scan> scans = decoded(made, packets, &counts);
  EXPECT_EQ(scans.size(), 4U);
  EXPECT_EQ(counts.lost, 5U);
  EXPECT_EQ(counts.late, 2U);
}

TEST(OusterDecoder, ACroppedViewLosesNothing) {
  OusterMetadata metadata = metadata_of(OusterProfile::legacy);
  metadata.window_begin = 448, metadata.window_end = 63;  // through angle 0
  EXPECT_EQ(metadata.window_size(), 128U);
  Made made = made_turns(metadata, 3);
  std::erase_if(made.packets,
                [&, i = std::size_t{0}](const EncodedPacket&) mutable { return !metadata.in_window(i++ % 32 * 16); });
  PacketCounts counts;
  const std::vector<Scan> scans = decoded(made, made.all(), &counts);
  EXPECT_EQ(scans.size(), 3U);
  EXPECT_EQ(counts.lost, 0U);
  for (const Scan& scan : scans) EXPECT_EQ(scan.cloud.size(), 128U * 16U);
}

TEST(OusterDecoder, TurnsOfLessThanHalfAreLeftOut) {
  const Made made = made_turns(metadata_of(OusterProfile::single), 2);
  std::vector<Packet> packets = made.all();
  packets.erase(packets.begin(), packets.begin() + 17);
  packets.pop_back();
  PacketCounts counts;
  EXPECT_TRUE(decoded(made, packets, &counts).empty());
  EXPECT_EQ(counts.incomplete, 2U);
}

TEST(OusterDecoder, PacketsOfAnotherSensorAreRefusedByItsSerialNumber) {
  OusterMetadata metadata = metadata_of(OusterProfile::single);
  metadata.serial = "122150000150", metadata.start = 77;
  Made made = made_turns(metadata, 1);
  for (EncodedPacket& packet : made.packets) {
    for (std::size_t i = 0; i < 5; ++i) packet.payload[7 + i] = std::byte(122150000150 >> 8 * i & 0xFF);
    packet.payload[4] = std::byte(78);
  }
  const OusterDecoder decoder(made.all(), {}, made.file);
  EXPECT_NE(decoder.decisions().back().find("another start"), std::string::npos) << decoder.decisions().back();
  made.file.ouster->serial = "992137000142";
  EXPECT_THROW(OusterDecoder(made.all(), {}, made.file), Error);
}

TEST(OusterMetadata, ComesBackFromItsText) {
  const OusterMetadata made = ouster_metadata_of(os1_64(), OusterProfile::low);
  const OusterMetadata read = parse_ouster_metadata(ouster_metadata_text(made), "made.json");
  EXPECT_EQ(read.product, made.product);
  EXPECT_EQ(read.profile, made.profile);
  EXPECT_EQ(read.columns, 1024U);
  EXPECT_EQ(read.rate, 10.0);
  EXPECT_EQ(read.window_end, 1023U);
  ASSERT_EQ(read.altitudes.size(), 64U);
  for (std::size_t i = 0; i < 64; ++i) EXPECT_NEAR(read.altitudes[i], made.altitudes[i], 1e-12);
  EXPECT_NEAR(read.beam_origin.x(), 0.0158, 1e-9);
  EXPECT_TRUE(read.T_sensor_lidar.isApprox(made.T_sensor_lidar));
}

TEST(OusterMetadata, WhatMakesNoSenseIsRefused) {
  const std::string text = ouster_metadata_text(ouster_metadata_of(os1_64(), OusterProfile::single));
  const auto refused = [&](const std::string& from, const std::string& to, const std::string& reason) {
    std::string broken = text;
    const std::size_t at = broken.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    broken.replace(at, from.size(), to);
    try {
      parse_ouster_metadata(broken, "os.json");
      ADD_FAILURE() << "no Error for " << to;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
    }
  };
  refused("beam_altitude_angles", "altitudes", "beam_altitude_angles");
  refused("RNG19_RFL8_SIG16_NIR16", "FIVE_WORD_PIXEL", "FIVE_WORD_PIXEL");
  refused("1024x10", "fast", "lidar_mode");
  refused("\"columns_per_frame\": 1024", "\"columns_per_frame\": 512", "columns_per_frame");
  refused("\"pixels_per_column\": 64", "\"pixels_per_column\": 32", "pixels_per_column");
  EXPECT_THROW(parse_ouster_metadata("[1]", "os.json"), Error);
  EXPECT_THROW(parse_ouster_metadata("{", "os.json"), Error);
  const Made made = made_turns(metadata_of(OusterProfile::single), 1);
  const SensorFile other{"os.json", ouster_metadata_of(os1_64(), OusterProfile::dual), std::nullopt};
  EXPECT_THROW(OusterDecoder(made.all(), {}, other), Error) << "packets of another length";
  EXPECT_THROW(make_packet_decoder(made.all(), {}), Error) << "no metadata";
}

}  // namespace
}  // namespace tilth
