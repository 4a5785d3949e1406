// Files about a unit: Velodyne's XML and YAML, tables of angles, Ouster's metadata; and what is none of them.
#include <numbers>
#include <sensor/made_packets.hpp>

#include <gtest/gtest.h>

#include <tilth/core/error.hpp>
#include <tilth/sensor/block_decoder.hpp>
#include <tilth/sensor/sensor_file.hpp>

namespace tilth {
namespace {

constexpr const char* kXml = R"(<?xml version="1.0" encoding="UTF-8" standalone="yes" ?>
<!DOCTYPE boost_serialization>
<boost_serialization signature="serialization::archive" version="4"><DB><distLSB_>0.2</distLSB_>
<enabled_><count>3</count><item>1</item><item>1</item><item>0</item></enabled_>
<points_><count>3</count>
<item><px><id_>0</id_><rotCorrection_>-5</rotCorrection_><vertCorrection_>-7.5</vertCorrection_>
<distCorrection_>120</distCorrection_><distCorrectionX_>123</distCorrectionX_><distCorrectionY_>121</distCorrectionY_>
<vertOffsetCorrection_>20</vertOffsetCorrection_><horizOffsetCorrection_>2.6</horizOffsetCorrection_></px></item>
<item><px><id_>1</id_><rotCorrection_>3</rotCorrection_><vertCorrection_>1.5</vertCorrection_></px></item>
<item><px><id_>2</id_><rotCorrection_>0</rotCorrection_><vertCorrection_>0</vertCorrection_></px></item>
</points_></DB></boost_serialization>)";

constexpr const char* kYaml = R"(num_lasers: 2
distance_resolution: 0.002
lasers:
- {laser_id: 0, rot_correction: -0.08726646, vert_correction: -0.1308997, dist_correction: 1.2, dist_correction_x: 1.23,
   dist_correction_y: 1.21, vert_offset_correction: 0.2, horiz_offset_correction: 0.026}
- {laser_id: 1, rot_correction: 0.05235988, vert_correction: 0.02617994, dist_correction: 0, dist_correction_x: 1,
   two_pt_correction_available: false}
)";

std::string refusal(const std::string& text) {
  try {
    parse_sensor_file(text, "unit");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(SensorFile, XmlAndYamlOfAVelodyneSayTheSame) {
  for (const char* text : {kXml, kYaml}) {
    const SensorFile file = parse_sensor_file(text, "unit");
    ASSERT_TRUE(file.unit);
    EXPECT_EQ(file.unit->origin, "unit");
    ASSERT_EQ(file.unit->lasers.size(), 2U) << "the third is not enabled";
    const auto& [elevation, offsets] = file.unit->lasers[0];
    EXPECT_NEAR(elevation / kDeg, -7.5, 1e-5);
    EXPECT_NEAR(offsets.azimuth / kDeg, 5.0, 1e-5) << "corrections are taken off";
    EXPECT_NEAR(offsets.range, 1.2, 1e-9);
    EXPECT_TRUE(offsets.two_points);
    EXPECT_NEAR(offsets.range_x, 1.23, 1e-9);
    EXPECT_NEAR(offsets.range_y, 1.21, 1e-9);
    EXPECT_NEAR(offsets.vertical, 0.2, 1e-9);
    EXPECT_NEAR(offsets.horizontal, 0.026, 1e-9);
    EXPECT_NEAR(file.unit->lasers[1].elevation / kDeg, 1.5, 1e-5);
    EXPECT_FALSE(file.unit->lasers[1].offsets.two_points);
  }
}

TEST(SensorFile, TablesOfAnglesMayNumberTheirLasers) {
  for (const char* text : {"Channel,Elevation,Azimuth\n1,14.5,1.25\n2,-3,-1.25\n",
                           "Laser id,Elevation,Azimuth\r\n1,14.5,1.25\r\n2,-3,-1.25\r\n", " 14.5,1.25\t\n-3,-1.25\n"}) {
    const SensorFile file = parse_sensor_file(text, "angles.csv");
    ASSERT_TRUE(file.unit) << text;
    ASSERT_EQ(file.unit->lasers.size(), 2U);
    EXPECT_NEAR(file.unit->lasers[0].elevation / kDeg, 14.5, 1e-9);
    EXPECT_NEAR(file.unit->lasers[1].offsets.azimuth / kDeg, -1.25, 1e-9);
  }
}

TEST(SensorFile, WhatIsNoneOfThemIsRefused) {
  EXPECT_NE(refusal("").find("tells of no laser"), std::string::npos);
  EXPECT_NE(refusal("Channel,Elevation,Azimuth\n").find("tells of no laser"), std::string::npos);
  EXPECT_NE(refusal("1,14.5,1.25\n3,1,1\n").find("lists laser 3"), std::string::npos)
      << refusal("1,14.5,1.25\n3,1,1\n");
  EXPECT_NE(refusal("1,14.5,1.25\nsomething else\n").find("something else"), std::string::npos);
  EXPECT_NE(refusal("1,1450,1\n").find("angle of laser 0"), std::string::npos);
  EXPECT_NE(refusal("lasers: 3\n").find("no list of lasers"), std::string::npos);
  EXPECT_NE(refusal("lasers:\n- {laser_id: 4}\n").find("lists laser 4"), std::string::npos);
  EXPECT_NE(refusal("<DB>").find("no XML"), std::string::npos);
  EXPECT_NE(refusal("<DB></DB>").find("tells of no laser"), std::string::npos);
  EXPECT_NE(refusal("{\"a\": 1}").find("beam_altitude_angles"), std::string::npos);
}

TEST(SensorFile, ReplacesTheTableOfASensorItFits) {
  const auto payloads = MadeSensor{}.packets(5);
  SensorFile file{"unit", std::nullopt, UnitCalibration{"unit", {}}};
  for (int i = 0; i < 16; ++i) {
    const double table = i % 2 == 0 ? -15.0 + i : i;
    file.unit->lasers.push_back({(table + 0.25) * kDeg, {.range = 0.1}});
  }
  const BlockDecoder decoder(packets_of(payloads), {}, file);
  EXPECT_NEAR(decoder.format().elevations[0] / kDeg, -14.75, 1e-9);
  EXPECT_EQ(decoder.format().offsets[3].range, 0.1);
  file.unit->lasers[4].elevation = 0.5;
  EXPECT_THROW(BlockDecoder(packets_of(payloads), {}, file), Error) << "of another sensor";
  EXPECT_THROW(BlockDecoder(packets_of(payloads), {}, {"os.json", OusterMetadata{}, std::nullopt}), Error);
}

}  // namespace
}  // namespace tilth
