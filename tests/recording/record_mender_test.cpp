// Units, offsets, byte orders and single bad values of clouds, understood and said or refused.
#include <algorithm>
#include <cmath>
#include <io/expect_error.hpp>
#include <limits>
#include <sensor/spinning_lidar.hpp>

#include <gtest/gtest.h>

#include <tilth/recording/record_edit.hpp>
#include <tilth/recording/record_mender.hpp>

namespace tilth {
namespace {

const std::vector<double> kVlp16 = beams_deg(16, -15, 2);

std::vector<Shot> shots(int scan) {
  return shots_of({kVlp16, 0.1, 170.0 - 3.0 * scan, 360, true, 0.1 * scan});
}

/// Coordinates times `scale` plus `offset`, as `type`.
PointRecords cloud(int scan, double scale, FieldType type = FieldType::f32,
                   const Eigen::Vector3d& offset = Eigen::Vector3d::Zero()) {
  std::vector<Shot> moved = shots(scan);
  for (Shot& shot : moved) shot.point = scale * shot.point + offset;
  PointRecords records = records_of(moved, {ring_field()});
  if (type == FieldType::f32) return records;
  std::vector<Eigen::Vector3d> points;
  for (const Shot& shot : moved) points.push_back(shot.point);
  return with_coordinates(records, roles_of(records), points);
}

std::vector<StampedRecords> scans_of(const auto& make, int count = 8) {
  std::vector<StampedRecords> all;
  for (int k = 0; k < count; ++k) all.push_back({{0.1 * k, std::nullopt}, make(k)});
  return all;
}

bool says(const std::vector<std::string>& sentences, const std::string& text) {
  return std::any_of(sentences.begin(), sentences.end(),
                     [&](const std::string& sentence) { return sentence.find(text) != std::string::npos; });
}

/// How far the mended points are from where they were measured, at most.
double error_of(const PointRecords& records, int scan) {
  const std::vector<Shot> truth = shots(scan);
  const std::vector<Eigen::Vector3d> points = coordinates_of(records, roles_of(records));
  EXPECT_EQ(points.size(), truth.size());
  double worst = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) worst = std::max(worst, (points[i] - truth[i].point).norm());
  return worst;
}

TEST(RecordMender, LeavesGoodCloudsBitForBit) {
  const auto first = scans_of([](int k) { return cloud(k, 1.0); });
  RecordMender mender(first, {});
  EXPECT_TRUE(mender.decisions().empty());
  PointRecords records = first[3].records;
  mender.mend(records);
  EXPECT_EQ(records.bytes, first[3].records.bytes);
  EXPECT_TRUE(mender.notices().empty());
}

TEST(RecordMender, FindsMillimetresAndCentimetres) {
  for (const auto& [scale, name] : {std::pair{1000.0, "millimetres"}, std::pair{100.0, "centimetres"}}) {
    for (const FieldType type : {FieldType::f32, FieldType::f64}) {
      const auto first = scans_of([&, s = scale](int k) { return cloud(k, s, type); });
      RecordMender mender(first, {});
      EXPECT_TRUE(says(mender.decisions(), std::string("coordinates are in ") + name)) << name;
      PointRecords records = first[2].records;
      mender.mend(records);
      EXPECT_LT(error_of(records, 2), 1e-5) << name;
      EXPECT_TRUE(mender.notices().empty());
    }
  }
}

TEST(RecordMender, FollowsAUnitThatChanges) {
  RecordMender mender(scans_of([](int k) { return cloud(k, 1.0); }), {});
  for (int k = 0; k < 12; ++k) {
    PointRecords records = cloud(k, k < 9 ? 1.0 : 1000.0);
    mender.mend(records);
    EXPECT_LT(error_of(records, k), 1e-5) << k;
  }
  EXPECT_TRUE(says(mender.notices(), "from scan 9 on coordinates are in millimetres, before in metres"));
}

TEST(RecordMender, ACoveredSensorChangesNoUnit) {
  RecordMender mender(scans_of([](int k) { return cloud(k, 1.0); }), {});
  for (const double scale : {1.0, 0.04, 0.04, 1.0, 3.0}) {  // a hand before it, then far walls
    PointRecords records = cloud(0, scale);
    mender.mend(records);
    EXPECT_EQ(records.bytes, cloud(0, scale).bytes) << scale;
  }
}

TEST(RecordMender, TakesTheUnitAskedFor) {
  const auto first = scans_of([](int k) { return cloud(k, 100.0); });
  RecordMender mender(first, {.unit = LengthUnit::millimetres});
  EXPECT_TRUE(says(mender.decisions(), "millimetres, as asked for"));
  PointRecords records = first[0].records;
  mender.mend(records);
  EXPECT_NEAR(coordinates_of(records, roles_of(records))[0].norm(), 0.1 * shots(0)[0].point.norm(), 1e-5);
}

TEST(RecordMender, RefusesAUnitThatMayBeTwo) {
  // Ranges of 16 m in centimetres or 1.6 m in millimetres, from a height that is odd for both.
  const ScanExtent extent{3.2, 2.45};
  expect_error([&] { unit_of_length(extent); }, {"coordinates", "--unit cm or --unit mm"});
}

TEST(RecordMender, SubtractsAnOffsetAndFindsTheSensorInIt) {
  const Eigen::Vector3d utm(492818.039, 5527515.847, 112.3);
  const auto first = scans_of([&](int k) { return cloud(k, 1.0, FieldType::f64, utm); });
  RecordMender mender(first, {});
  EXPECT_TRUE(says(mender.decisions(), "(492818.039, 5527515.847, 112.300)")) << mender.decisions().at(0);
  PointRecords records = first[4].records;
  mender.mend(records);
  EXPECT_LT(error_of(records, 4), 1e-3);
}

TEST(RecordMender, RefusesAnOffsetThatFloatsCannotHold) {
  const auto first = scans_of([](int k) { return cloud(k, 1.0, FieldType::f32, {492818.0, 5527515.0, 112.0}); });
  expect_error([&] { RecordMender(first, {}); }, {"coordinates", "float32", "write doubles"});
}

TEST(RecordMender, RefusesScansThatAreRegisteredAlready) {
  const auto first = scans_of([](int k) {
    return cloud(k, 1.0, FieldType::f64, {492818.0 + 0.2 * k, 5527515.0, 112.0});
  });
  expect_error([&] { RecordMender(first, {}); }, {"those of a map", "1.40 m"});
}

TEST(RecordMender, ReadsNumbersInTheOrderTheyAreIn) {
  auto first = scans_of([](int k) { return cloud(k, 1.0); });
  for (StampedRecords& scan : first) scan.records.byte_order = std::endian::big;
  RecordMender mender(first, {});
  EXPECT_TRUE(says(mender.decisions(), "little-endian, which is not what the clouds state"));
  PointRecords records = first[1].records;
  mender.mend(records);
  EXPECT_LT(error_of(records, 1), 1e-5);
  EXPECT_TRUE(says(mender.notices(), "1 clouds state another"));
}

// Some drivers write a number beyond all sense where nothing came back.
TEST(RecordMender, PointsBeyondAllSenseAreNoPlane) {
  const auto first = scans_of([](int k) {
    std::vector<Shot> shots = shots_of({{-15.0, -5.0, 5.0, 15.0}, 0.1, 10.0 * k, 270});
    for (std::size_t i = 0; i < shots.size(); i += 19) shots[i].point = Eigen::Vector3d::Constant(1e9);
    return records_of(shots, {});
  });
  RecordMender mender(first, {});
  for (StampedRecords scan : first) mender.mend(scan.records);
  EXPECT_FALSE(says(mender.notices(), "millimetres"));
}

// One scan of far away things is no change of units, and the one after it is as those before.
TEST(RecordMender, AScanOfFarThingsChangesNoUnit) {
  std::vector<StampedRecords> scans = scans_of([](int k) { return cloud(k, k == 5 ? 25.0 : 1.0); });
  RecordMender mender({scans.begin(), scans.begin() + 4}, {});
  for (StampedRecords& scan : scans) mender.mend(scan.records);
  EXPECT_FALSE(says(mender.notices(), "centimetres"));
  EXPECT_LT(error_of(scans[6].records, 6), 1e-5);
}

TEST(RecordMender, RefusesFlatClouds) {
  const auto flat = [](double height, double tilt) {
    return scans_of([=](int k) {
      std::vector<Shot> level = shots_of({{0.0}, 0.1, 10.0 * k, 270});
      for (Shot& shot : level)
        shot.point = {shot.point.x() * std::cos(tilt), shot.point.y(), height - shot.point.x() * std::sin(tilt)};
      return records_of(level, {});
    });
  };
  for (const auto& [height, tilt] : {std::pair{0.0, 0.0}, std::pair{0.3, 0.0}, std::pair{0.0, 0.4}})
    expect_error([&, h = height, t = tilt] { RecordMender(flat(h, t), {}); }, {"one plane", "2D laser scanner", "3D"});
}

PointRecords with_rings(int scan, double bad, std::size_t every) {
  std::size_t i = 0;
  return records_of(shots(scan), {{"ring", FieldType::f32,
                                   [&, bad](const Shot& s) { return ++i % every == 0 ? bad : double(s.ring); }}});
}

TEST(RecordMender, LeavesOutPointsWhoseRingIsNone) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {65535.0, nan, -1.0, 900.0, 20.0, 1e9}) {
    for (const int from : {0, 5}) {  // among the first scans, or after them
      RecordMender mender(scans_of([&](int k) { return with_rings(k, bad, k >= from ? 100 : 1000000); }), {});
      PointRecords records = with_rings(9, bad, 100);
      mender.mend(records);
      EXPECT_EQ(records.count, 9600u - 96u) << bad;
      for (const double ring : column(records, *records.find("ring"))) ASSERT_TRUE(ring >= 0.0 && ring < 16.0) << bad;
      EXPECT_TRUE(says(mender.notices(), "ring: 96 points of 1 scans are left out")) << bad;
    }
  }
}

TEST(RecordMender, ReadsNoRingsWhereMostAreNone) {
  RecordMender mender(scans_of([](int k) { return with_rings(k, 0.0, 1000000); }), {});
  PointRecords records = with_rings(9, 65535.0, 1);
  mender.mend(records);
  EXPECT_EQ(records.count, 9600u);
  EXPECT_EQ(records.find("ring"), nullptr);
  EXPECT_TRUE(says(mender.notices(), "ring: not read in 1 scans"));
}

PointRecords with_times(int scan, double bad, std::size_t every) {
  std::size_t i = 0;
  return records_of(shots(scan), {ring_field(), {"t", FieldType::f64, [&, bad, scan](const Shot& s) {
                                                   return ++i % every == 0 ? bad
                                                                           : std::round((s.time - 0.1 * scan) * 1e9);
                                                 }}});
}

TEST(RecordMender, LeavesOutPointsWhoseTimeIsNone) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {3604361924.0, nan, -5e9, 1e300}) {
    for (const std::size_t every : {2, 500}) {  // half of them, or a few
      RecordMender mender(scans_of([&](int k) { return with_times(k, bad, k < 2 ? every : 1000000); }), {});
      PointRecords records = with_times(0, bad, every);
      mender.mend(records);
      EXPECT_EQ(records.count, 9600u - 9600u / every) << bad;
      EXPECT_TRUE(says(mender.notices(), "time: " + std::to_string(9600 / every) + " points of 1 scans")) << bad;
    }
  }
}

}  // namespace
}  // namespace tilth
