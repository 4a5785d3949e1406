// Real recordings of several sensors; skipped by name where they are not at hand.
#include <cmath>
#include <filesystem>
#include <numbers>

#include <gtest/gtest.h>

#include "support/real_recording.hpp"
#include <tilth/io/pcd.hpp>
#include <tilth/sensor/scan_decoder.hpp>
#include <tilth/sources/open_source.hpp>
#include <tilth/sources/scan_files.hpp>

namespace tilth {
namespace {

bool says(const std::vector<std::string>& decisions, const std::string& text) {
  for (const std::string& sentence : decisions) {
    if (sentence.find(text) != std::string::npos) return true;
  }
  return false;
}

double azimuth(const Eigen::Vector3d& p) {
  return std::atan2(p.y(), p.x());
}

TEST(RealRecording, VelodyneInFiringOrderGetsTheTimesOfItsSpin) {
  const auto folder = recording("vlp16-outdoor-loop");
  NEEDS(folder);
  const auto source = open_source(folder.string(), {});
  EXPECT_EQ(source->size(), 406u);
  EXPECT_TRUE(says(source->decisions(), "clockwise, 363.2 deg a scan), spin period 0.1000 s from the stamps"));
  double last = -1.0;
  std::size_t scans = 0;
  for (; auto scan = source->next(); ++scans) {
    ASSERT_TRUE(scan->cloud.has_rings() && scan->cloud.has_times());
    ASSERT_GT(scan->stamp, last);
    last = scan->stamp;
    const PointCloud& cloud = scan->cloud;
    double turned = 0.0;  // the recording's own rule: 600 rpm, clockwise, from the first point
    for (std::size_t i = 1; i < cloud.size(); ++i) {
      turned -= std::remainder(azimuth(cloud.points[i]) - azimuth(cloud.points[i - 1]), 2 * std::numbers::pi);
      ASSERT_NEAR(cloud.times[i], turned / (2 * std::numbers::pi) * 0.1, 1e-4) << "scan " << scans << " point " << i;
    }
  }
  EXPECT_EQ(scans, 406u);
  EXPECT_TRUE(source->skipped().empty());
}

TEST(RealRecording, ScansFarApartGetNoTimesFromANominalRate) {
  const auto folder = recording("vlp16-corridor");
  NEEDS(folder);
  const auto source = open_source(folder.string(), {});
  EXPECT_TRUE(says(source->decisions(), "nominal rate of 10 Hz"));
  EXPECT_TRUE(says(source->decisions(), "no point times"));
  EXPECT_FALSE(source->next()->cloud.has_times());
}

TEST(RealRecording, RecorderCountersAreNoSeconds) {
  const auto folder = recording("rs16-static-room");
  NEEDS(folder);
  const auto source = open_source(folder.string(), {});
  EXPECT_TRUE(says(source->decisions(), "nominal rate of 10 Hz"));
  EXPECT_EQ(source->next()->stamp, 0.0);
  const auto second = source->next();
  EXPECT_EQ(second->stamp, 0.1);
  EXPECT_NEAR(second->cloud.times.back(), 0.1, 1e-3);
}

/// Rings worked out without the ring field, against the field.
void expect_rings_found(const std::filesystem::path& folder, double least_equal) {
  std::vector<StampedRecords> with_field, without_field;
  const auto files = find_scan_files(folder);
  for (std::size_t k = 0; k < std::min<std::size_t>(files.size(), 8); ++k) {
    with_field.push_back({{0.1 * double(k), {}}, read_pcd(files[k])});
    without_field.push_back(with_field.back());
    std::erase_if(without_field.back().records.fields, [](const PointField& f) { return f.name == "ring"; });
  }
  const ScanDecoder told(with_field, {}), found(without_field, {});
  EXPECT_TRUE(says(found.decisions(), "derived from elevation: 16 beams"));
  const Scan a = told.decode(with_field[0]), b = found.decode(without_field[0]);
  ASSERT_TRUE(a.cloud.has_rings() && b.cloud.has_rings());
  ASSERT_EQ(a.cloud.size(), b.cloud.size());
  std::size_t equal = 0;
  for (std::size_t i = 0; i < a.cloud.size(); ++i) equal += a.cloud.rings[i] == b.cloud.rings[i] ? 1 : 0;
  EXPECT_GT(double(equal), least_equal * double(a.cloud.size()));
}

TEST(RealRecording, SixteenBeamsAreFoundWithoutTheRingField) {
  for (const char* name : {"vlp16-outdoor-loop", "vlp16-corridor", "rs16-static-room"}) {
    SCOPED_TRACE(name);
    const auto folder = recording(name);
    NEEDS(folder);
    expect_rings_found(folder, 0.999);
  }
  const auto leishen = recording("pairs/ndt_python");
  NEEDS(leishen);
  expect_rings_found(leishen, 0.98);
}

TEST(RealRecording, HesaiWithoutRingAndTimeIsInFiringOrder) {
  const auto folder = recording("xt32-hilti14");
  NEEDS(folder);
  const auto source = open_source(folder.string(), {});
  EXPECT_TRUE(says(source->decisions(), "derived from elevation"));
  EXPECT_TRUE(says(source->decisions(), "a GUESS from the nominal rate"));
  std::size_t scans = 0;
  for (; auto scan = source->next(); ++scans) {
    ASSERT_TRUE(scan->cloud.has_rings() && scan->cloud.has_times());
    const PointCloud& cloud = scan->cloud;
    for (std::size_t i = 0; i < cloud.size(); i += 50) {  // clockwise from 89.86 degrees at the stamp k / 10 Hz
      const double phase = 10.0 * (scan->stamp + cloud.times[i] - 0.1 * double(scans));
      const double turned = (89.86 / 180.0 * std::numbers::pi - azimuth(cloud.points[i])) / (2 * std::numbers::pi);
      ASSERT_NEAR(std::remainder(phase - turned, 1.0), 0.0, 2e-3) << "scan " << scans << " point " << i;
    }
  }
  EXPECT_EQ(scans, 30u);
}

TEST(RealRecording, KittiHasSixtyFourRingsAndNoTimes) {
  const auto folder = recording("kitti00-first16");
  NEEDS(folder);
  const auto source = open_source(folder.string(), {});
  EXPECT_TRUE(says(source->decisions(), "deskewed already"));
  while (auto scan = source->next()) {
    ASSERT_TRUE(scan->cloud.has_rings());
    EXPECT_FALSE(scan->cloud.has_times());
    EXPECT_EQ(*std::max_element(scan->cloud.rings.begin(), scan->cloud.rings.end()), 63);
    EXPECT_EQ(scan->cloud.rings.front(), 63);
  }
}

TEST(RealRecording, LeishenWithAbsoluteTimes) {
  const auto folder = recording("pairs/ndt_python");
  NEEDS(folder);
  const auto source = open_source(folder.string(), {});
  const auto scan = source->next();
  EXPECT_NEAR(scan->stamp, 1686034812.9763427, 1e-6);
  EXPECT_NEAR(*std::max_element(scan->cloud.times.begin(), scan->cloud.times.end()), 0.1000306, 1e-5);
}

TEST(RealRecording, PlyOfAHdl32HasItsRings) {
  const auto file = recording("pairs/small_gicp/source.ply");
  NEEDS(file);
  const auto source = open_source(file.string(), {});
  EXPECT_TRUE(says(source->decisions(), "32 beams"));
  EXPECT_GT(source->next()->cloud.size(), 60000u);
}

}  // namespace
}  // namespace tilth
