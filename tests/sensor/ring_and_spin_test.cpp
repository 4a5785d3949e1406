// Rings and times worked out from the points where no field tells them.
#include <algorithm>
#include <io/expect_error.hpp>
#include <random>
#include <sensor/spinning_lidar.hpp>

#include <gtest/gtest.h>

#include <tilth/core/error.hpp>
#include <tilth/sensor/beams.hpp>
#include <tilth/sensor/firing_order.hpp>
#include <tilth/sensor/scan_decoder.hpp>

namespace tilth {
namespace {

const std::vector<double> kVlp16 = beams_deg(16, -15, 2);

std::vector<Eigen::Vector3d> points_of(const std::vector<Shot>& shots) {
  std::vector<Eigen::Vector3d> points;
  for (const Shot& shot : shots) points.push_back(shot.point);
  return points;
}

/// Scans one after another, each beginning where the one before ended, stamped by their first shot.
struct Recording {
  std::vector<StampedRecords> records;
  std::vector<std::vector<Shot>> shots;
};

Recording recording_of(Spin spin, const std::vector<RecordField>& fields, int scans = 8) {
  Recording recording;
  for (int k = 0; k < scans; ++k) {
    recording.shots.push_back(shots_of(spin));
    recording.records.push_back({{spin.start, std::nullopt}, records_of(recording.shots.back(), fields)});
    spin.start += spin.period * spin.covered_deg / 360.0;
    spin.start_deg += spin.clockwise ? -spin.covered_deg : spin.covered_deg;
  }
  return recording;
}

bool says(const ScanDecoder& decoder, const std::string& text) {
  return std::any_of(decoder.decisions().begin(), decoder.decisions().end(),
                     [&](const std::string& sentence) { return sentence.find(text) != std::string::npos; });
}

TEST(Beams, AreFoundForTheSensorsOfTheWorld) {
  const std::vector<std::vector<double>> sensors{
      kVlp16,
      beams_deg(16, -10, 4.0 / 3.0),
      beams_deg(32, -30.67, 4.0 / 3.0),
      beams_deg(32, -16, 1.0),
      beams_deg(64, -16.6, 0.53),
      beams_deg(128, -22.5, 0.355),
      {-25, -15.6, -11.3, -8.8, -7.2, -6.1, -5.3, -4.7, -4, -3.3, -2.3, -1.6, 0, 1.3, 4.7, 10.3}};
  std::mt19937 random(1);
  for (const std::vector<double>& elevations : sensors) {
    std::normal_distribution<double> noise(0.0, 0.012);
    std::vector<double> measured;
    for (int i = 0; i < 400; ++i) {
      for (const double e : elevations) measured.push_back((e + noise(random)) * std::numbers::pi / 180.0);
    }
    const std::vector<double> beams = find_beams(measured);
    ASSERT_EQ(beams.size(), elevations.size());
    for (std::size_t b = 0; b < beams.size(); ++b) EXPECT_NEAR(beams[b] * 180.0 / std::numbers::pi, elevations[b], 0.1);
  }
}

TEST(Beams, AreNotFoundWhereThereAreNone) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> even(-0.4, 0.4);
  std::vector<double> measured(20000);
  for (double& e : measured) e = even(random);
  EXPECT_TRUE(find_beams(measured).empty());
  EXPECT_TRUE(find_beams(std::vector<double>(5, 0.1)).empty());
}

TEST(Rings, ComeFromElevationWithoutAField) {
  // A sensor whose beams start 4 cm off its axis: elevation is blurred at near range.
  Recording recording = recording_of({kVlp16}, {});
  for (auto& shots : recording.shots) {
    for (Shot& s : shots) s.point += 0.04 * Eigen::Vector3d(s.point.x(), s.point.y(), 0).normalized();
  }
  std::vector<StampedRecords> records;
  for (const auto& shots : recording.shots) records.push_back({{shots.front().time, {}}, records_of(shots, {})});
  const ScanDecoder decoder(records, {});
  EXPECT_TRUE(says(decoder, "16 beams"));
  const Scan scan = decoder.decode(records[0]);
  ASSERT_TRUE(scan.cloud.has_rings());
  for (std::size_t i = 0; i < scan.cloud.size(); ++i) ASSERT_EQ(scan.cloud.rings[i], recording.shots[0][i].ring);
}

TEST(Rings, CountFromTheLowestBeamWhateverTheFieldCounts) {
  const RecordField from_top{"ring", FieldType::u8, [](const Shot& s) { return 15.0 - s.ring; }};
  const RecordField laser_id{"channel", FieldType::u16, [](const Shot& s) { return double((s.ring * 7) % 16); }};
  for (const RecordField& field : {from_top, laser_id}) {
    const Recording recording = recording_of({kVlp16}, {field});
    const Scan scan = ScanDecoder(recording.records, {}).decode(recording.records[1]);
    ASSERT_TRUE(scan.cloud.has_rings());
    for (std::size_t i = 0; i < scan.cloud.size(); ++i) ASSERT_EQ(scan.cloud.rings[i], recording.shots[1][i].ring);
  }
}

TEST(Rings, AFieldThatNamesNoRingsIsNotBelieved) {
  for (const double value : {0.0, -1.0, 0.5}) {
    const Recording recording = recording_of({kVlp16}, {{"ring", FieldType::f32, [=](const Shot&) { return value; }}});
    const ScanDecoder decoder(recording.records, {});
    EXPECT_TRUE(says(decoder, "names no rings, derived from elevation: 16 beams")) << value;
  }
}

TEST(Rings, StoredOneAfterAnotherAreRecognisedAndHaveNoTimes) {
  Recording recording = recording_of({beams_deg(64, -24, 0.42), 0.1, 0, 360, false}, {}, 2);
  for (std::size_t k = 0; k < 2; ++k) {
    std::stable_sort(recording.shots[k].begin(), recording.shots[k].end(),
                     [](const Shot& a, const Shot& b) { return a.ring > b.ring; });
    recording.records[k].records = records_of(recording.shots[k], {});
  }
  const ScanDecoder decoder(recording.records, {});
  EXPECT_TRUE(says(decoder, "64 rings one after another"));
  EXPECT_TRUE(says(decoder, "not in the order of firing"));
  const Scan scan = decoder.decode(recording.records[0]);
  ASSERT_TRUE(scan.cloud.has_rings());
  EXPECT_FALSE(scan.cloud.has_times());
  for (std::size_t i = 0; i < scan.cloud.size(); ++i) ASSERT_EQ(scan.cloud.rings[i], recording.shots[0][i].ring);
}

struct SpinCase {
  double period, start_deg, covered_deg;
  bool clockwise;
};

class FiringOrder : public testing::TestWithParam<SpinCase> {};

TEST_P(FiringOrder, GivesTheTimesOfTheShots) {
  const SpinCase c = GetParam();
  const Recording recording =
      recording_of({kVlp16, c.period, c.start_deg, c.covered_deg, c.clockwise, 1000.0}, {ring_field()});
  const ScanDecoder decoder(recording.records, {});
  EXPECT_TRUE(says(decoder, c.clockwise ? "(clockwise" : "(counter-clockwise"));
  for (std::size_t k = 0; k < recording.records.size(); ++k) {
    const Scan scan = decoder.decode(recording.records[k]);
    ASSERT_TRUE(scan.cloud.has_times());
    EXPECT_EQ(scan.stamp, recording.records[k].stamp.stamp);
    for (std::size_t i = 0; i < scan.cloud.size(); ++i) {
      ASSERT_NEAR(scan.cloud.times[i], recording.shots[k][i].time - scan.stamp, 2e-3 * c.period);
      ASSERT_EQ(scan.cloud.points[i], recording.shots[k][i].point.cast<float>().cast<double>());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Spins, FiringOrder,
                         testing::Values(SpinCase{0.1, 163, 363.2, true}, SpinCase{0.1, 163, 363.2, false},
                                         SpinCase{0.2, -179, 360, true}, SpinCase{0.05, 10, 361, true},
                                         SpinCase{0.05, 180, 360.6, false}, SpinCase{0.1, 60, 360, true}));

TEST(FiringOrderOf, BeamsOffsetInAzimuthAndWithGapsKeepsTheTimes) {
  std::vector<Shot> shots = shots_of({kVlp16});
  std::erase_if(shots, [](const Shot& s) { return std::abs(s.point.x()) > 7.9 && s.point.y() > 0 && s.ring > 3; });
  std::vector<std::uint16_t> rings;
  for (Shot& s : shots) {
    rings.push_back(std::uint16_t(s.ring));
    const Eigen::AngleAxisd offset((s.ring % 2 == 0 ? 5.0 : -5.0) * std::numbers::pi / 180.0, Eigen::Vector3d::UnitZ());
    s.point = offset * s.point;
  }
  const std::optional<HeadRotation> rotation = find_head_rotation(points_of(shots), rings);
  ASSERT_TRUE(rotation);
  for (std::size_t i = 0; i < shots.size(); ++i) {
    ASSERT_NEAR(rotation->progress[i] / (2 * std::numbers::pi) * 0.1, shots[i].time - shots[0].time, 5e-4);
  }
}

TEST(FiringOrderOf, PointsInNoOrderIsNone) {
  std::vector<Shot> shots = shots_of({kVlp16});
  std::shuffle(shots.begin(), shots.end(), std::mt19937(3));
  EXPECT_FALSE(find_head_rotation(points_of(shots), {}));
  EXPECT_FALSE(find_head_rotation(points_of({shots[0]}), {}));
  const Eigen::Vector3d same(1, 2, 3);
  EXPECT_FALSE(find_head_rotation(std::vector<Eigen::Vector3d>(100, same), {}));
}

TEST(SpinPeriod, FromStampsThatSkipScansIsAssumedAndSaidSo) {
  Recording recording = recording_of({kVlp16}, {ring_field()});
  for (std::size_t k = 0; k < recording.records.size(); ++k) recording.records[k].stamp.stamp = double(k);
  const ScanDecoder decoder(recording.records, {});
  EXPECT_TRUE(says(decoder, "ASSUMED 0.1000 s"));
  EXPECT_NEAR(decoder.decode(recording.records[0]).cloud.times.back(), 0.1, 1e-3);
}

TEST(SpinPeriod, FromNominalStampsNeedsScansThatMayFollowOneAnother) {
  Recording follows = recording_of({kVlp16, 0.1, 170, 363}, {ring_field()});
  EXPECT_TRUE(says(ScanDecoder(follows.records, {true, false}), "each scan begins where the one before ended"));
  Recording fixed_cut = recording_of({kVlp16, 0.1, 170, 360}, {ring_field()});
  EXPECT_TRUE(says(ScanDecoder(fixed_cut.records, {true, false}), "a GUESS from the nominal rate"));
  std::vector<StampedRecords> gaps;
  for (int k = 0; k < 5; ++k) {
    gaps.push_back({{0.1 * k, {}}, records_of(shots_of({kVlp16, 0.1, 170.0 - 37 * k, 361}), {ring_field()})});
  }
  const ScanDecoder decoder(gaps, {true, false});
  EXPECT_TRUE(says(decoder, "no point times"));
  EXPECT_FALSE(decoder.decode(gaps[0]).cloud.has_times());
}

TEST(SpinPeriod, OfARayCastersSnapshotIsNone) {
  std::vector<Shot> shots = shots_of({kVlp16, 0.1, -180, 360, false});
  for (Shot& s : shots) {  // every beam of a column in the same direction
    const double azimuth = -std::numbers::pi + 2 * std::numbers::pi * std::floor(s.time / 0.1 * 600) / 600;
    const double distance = s.point.head<2>().norm();
    s.point.head<2>() = distance * Eigen::Vector2d(std::cos(azimuth), std::sin(azimuth));
  }
  std::vector<StampedRecords> recording;
  for (int k = 0; k < 4; ++k) recording.push_back({{0.1 * k, {}}, records_of(shots, {ring_field()})});
  const ScanDecoder decoder(recording, {});
  EXPECT_TRUE(says(decoder, "snapshots"));
  EXPECT_FALSE(decoder.decode(recording[0]).cloud.has_times());
}

TEST(DeskewedScans, HaveNoTimes) {
  const Recording recording = recording_of({kVlp16}, {ring_field()});
  const ScanDecoder decoder(recording.records, {false, true});
  EXPECT_TRUE(says(decoder, "deskewed already"));
  EXPECT_FALSE(decoder.decode(recording.records[0]).cloud.has_times());
}

const RecordField kTimes{"time", FieldType::f32, [](const Shot& s) { return s.time; }};

TEST(TimesAskedFor, NoneMeansTheStampWhateverTheRecordingHolds) {
  for (const std::vector<RecordField>& fields : {std::vector{ring_field()}, std::vector{ring_field(), kTimes}}) {
    const Recording recording = recording_of({kVlp16}, fields);
    ASSERT_TRUE(ScanDecoder(recording.records, {}).decode(recording.records[1]).cloud.has_times());
    const ScanDecoder decoder(recording.records, {.times = CloudTimes::none});
    EXPECT_TRUE(says(decoder, "time: none, as asked for"));
    const Scan scan = decoder.decode(recording.records[1]);
    EXPECT_TRUE(scan.cloud.times.empty());
    EXPECT_EQ(scan.stamp, recording.records[1].stamp.stamp);
    EXPECT_TRUE(scan.cloud.has_rings());
  }
}

TEST(TimesAskedFor, DerivedPassOverAFieldAndWhatTheFormatSays) {
  const RecordField zero{"time", FieldType::f32, [](const Shot&) { return 0.0; }};
  const Recording recording = recording_of({kVlp16}, {ring_field(), zero});
  EXPECT_FALSE(ScanDecoder(recording.records, {}).decode(recording.records[1]).cloud.has_times());
  const ScanDecoder decoder(recording.records, {.deskewed = true, .times = CloudTimes::derived});
  EXPECT_TRUE(says(decoder, "no field is read, as asked for"));
  const Scan scan = decoder.decode(recording.records[1]);
  ASSERT_TRUE(scan.cloud.has_times());
  EXPECT_NEAR(scan.cloud.times.back(), recording.shots[1].back().time - scan.stamp, 2e-4);
}

TEST(TimesAskedFor, DerivedAreRefusedWhereThePointsTellNone) {
  Recording recording = recording_of({kVlp16}, {ring_field(), kTimes}, 2);
  for (std::size_t k = 0; k < 2; ++k) {
    std::shuffle(recording.shots[k].begin(), recording.shots[k].end(), std::mt19937(3));
    recording.records[k].records = records_of(recording.shots[k], {ring_field(), kTimes});
  }
  expect_error([&] { ScanDecoder(recording.records, {.times = CloudTimes::derived}); },
               {"times=derived", "not in the order of firing"});
}

}  // namespace
}  // namespace tilth
