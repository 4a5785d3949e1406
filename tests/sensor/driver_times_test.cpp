// Per-point times as drivers write them: name, type, unit, instant they count from, and which end the stamp marks.
#include <cmath>
#include <ostream>
#include <sensor/spinning_lidar.hpp>

#include <gtest/gtest.h>

#include <tilth/sensor/scan_decoder.hpp>

namespace tilth {
namespace {

constexpr double kEpoch = 1700000000.25;

enum class Stamp { start, end, sensor_off };

struct Driver {
  const char* name;
  const char* field;
  FieldType type;
  /// Value of the field for a shot at `t` in a scan from `begin` to `end`, all [s].
  double (*value)(double t, double begin, double end);
  Stamp stamp = Stamp::start;
  const char* said;             ///< in the decision
  double arrival_delay = -1.0;  ///< [s] after the end of the scan; negative: not known
};

std::ostream& operator<<(std::ostream& out, const Driver& driver) {
  return out << driver.name;
}

double since_begin(double t, double begin, double) {
  return t - begin;
}
double since_end(double t, double, double end) {
  return t - end;
}
double absolute(double t, double, double) {
  return t;
}

const Driver kDrivers[] = {
    {"velodyne_last_packet", "time", FieldType::f32, since_end, Stamp::end, "in seconds relative to the end"},
    {"velodyne_first_packet", "time", FieldType::f32, since_begin, Stamp::start, "in seconds since the start"},
    {"lslidar", "time", FieldType::f32, since_begin, Stamp::end, "stamp marks its end", 0.004},
    {"ouster", "t", FieldType::u32, [](double t, double b, double) { return std::round((t - b) * 1e9); }, Stamp::start,
     "field 't' (u32) in nanoseconds since the start", 0.012},
    {"hesai", "timestamp", FieldType::f64, absolute, Stamp::start, "in seconds absolute"},
    {"rslidar_last", "timestamp", FieldType::f64, absolute, Stamp::end, "in seconds absolute"},
    {"livox", "timestamp", FieldType::f64, [](double t, double, double) { return t * 1e9; }, Stamp::start,
     "in nanoseconds absolute"},
    {"livox_custom", "offset_time", FieldType::u32, [](double t, double b, double) { return (t - b) * 1e9; },
     Stamp::start, "in nanoseconds since"},
    {"nebula", "time_stamp", FieldType::u32, [](double t, double b, double) { return (t - b) * 1e9; }, Stamp::start,
     "in nanoseconds since"},
    {"liosam_ms", "timeStamp", FieldType::f32, [](double t, double b, double) { return (t - b) * 1e3; }, Stamp::start,
     "in milliseconds"},
    {"velodyne_us", "scalar_time", FieldType::f32, [](double t, double b, double) { return (t - b) * 1e6; },
     Stamp::start, "in microseconds"},
    {"uptime", "timestamp", FieldType::f64, [](double t, double, double) { return t - kEpoch + 812.5; },
     Stamp::sensor_off, "on another clock"},
};

struct Case {
  Driver driver;
  double period;
  double covered_deg;
};

class DriverTimes : public testing::TestWithParam<std::tuple<Driver, double, double>> {};

TEST_P(DriverTimes, GiveTheFirstPointsStampAndTimesFromIt) {
  const auto& [driver, period, covered] = GetParam();
  std::vector<StampedRecords> recording;
  std::vector<std::vector<Shot>> truth;
  for (int k = 0; k < 8; ++k) {
    const double begin = kEpoch + k * period;
    const std::vector<Shot> shots = shots_of({beams_deg(16, -15, 2), period, 170, covered, true, begin});
    const double end = shots.back().time;
    const RecordField time{driver.field, driver.type,
                           [&, begin, end, d = driver](const Shot& s) { return d.value(s.time, begin, end); }};
    CloudStamp stamp{driver.stamp == Stamp::end ? end : begin, std::nullopt};
    if (driver.arrival_delay >= 0.0) stamp.arrival = end + driver.arrival_delay + 1e-4 * k;
    recording.push_back({stamp, records_of(shots, {intensity_field(), ring_field(), time})});
    truth.push_back(shots);
  }
  const ScanDecoder decoder(recording, {});
  ASSERT_GE(decoder.decisions().size(), 4u);
  EXPECT_NE(decoder.decisions()[3].find(driver.said), std::string::npos) << decoder.decisions()[3];
  for (std::size_t k = 0; k < recording.size(); ++k) {
    const Scan scan = decoder.decode(recording[k]);
    ASSERT_EQ(scan.cloud.size(), truth[k].size());
    ASSERT_TRUE(scan.cloud.has_times());
    EXPECT_NEAR(scan.stamp, truth[k].front().time, 2e-6);
    for (std::size_t i = 0; i < truth[k].size(); i += 97) {
      EXPECT_NEAR(scan.cloud.times[i], truth[k][i].time - truth[k].front().time, 1e-6);
      EXPECT_EQ(scan.cloud.rings[i], truth[k][i].ring);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(AllRatesAndPartialScans, DriverTimes,
                         testing::Combine(testing::ValuesIn(kDrivers), testing::Values(0.2, 0.1, 0.05),
                                          testing::Values(360.0, 120.0)),
                         [](const auto& p) {
                           return std::string(std::get<0>(p.param).name) + "_" +
                                  std::to_string(int(1.0 / std::get<1>(p.param))) + "Hz_" +
                                  std::to_string(int(std::get<2>(p.param))) + "deg";
                         });

/// Eight scans whose field 'time' is filled by `value`.
std::vector<StampedRecords> recording_with(FieldType type, const FieldValue& value, double period = 0.1) {
  std::vector<StampedRecords> recording;
  for (int k = 0; k < 8; ++k) {
    const Spin spin{beams_deg(16, -15, 2), period, 170, 360, true, kEpoch + k * period};
    recording.push_back(
        {{spin.start, std::nullopt}, records_of(shots_of(spin), {ring_field(), {"time", type, value}})});
  }
  return recording;
}

TEST(DriverTimesTraps, ZerosOfASimulatorAreASnapshotAndNothingIsDerived) {
  const auto recording = recording_with(FieldType::f32, [](const Shot&) { return 0.0; });
  const ScanDecoder decoder(recording, {});
  EXPECT_NE(decoder.decisions()[3].find("snapshots"), std::string::npos) << decoder.decisions()[3];
  EXPECT_FALSE(decoder.decode(recording[0]).cloud.has_times());
}

TEST(DriverTimesTraps, EpochInFloat32IsRefusedAndTimesComeFromTheFiringOrder) {
  const auto recording = recording_with(FieldType::f32, [](const Shot& s) { return s.time; });
  const ScanDecoder decoder(recording, {});
  EXPECT_NE(decoder.decisions()[3].find("float32"), std::string::npos) << decoder.decisions()[3];
  const Scan scan = decoder.decode(recording[2]);
  ASSERT_TRUE(scan.cloud.has_times());
  EXPECT_NEAR(scan.cloud.times.back(), 0.1, 5e-4);
}

TEST(DriverTimesTraps, SpansThatFitNoUnitAreRefused) {
  const auto recording = recording_with(
      FieldType::f64, [](const Shot& s) { return (s.time - kEpoch) * 50.0; }, 0.1);
  const ScanDecoder decoder(recording, {});
  EXPECT_NE(decoder.decisions()[3].find("in no unit"), std::string::npos) << decoder.decisions()[3];
}

TEST(DriverTimesTraps, PointsWithAbsurdTimesAreLeftOut) {
  auto recording = recording_with(FieldType::f64, [](const Shot& s) { return s.time; });
  const double zero = 0.0, nan = std::nan("");
  PointRecords& records = recording[3].records;
  const std::size_t offset = records.find("time")->offset;
  std::memcpy(records.bytes.data() + 100 * records.stride + offset, &zero, 8);
  std::memcpy(records.bytes.data() + 200 * records.stride + offset, &nan, 8);
  const Scan scan = ScanDecoder(recording, {}).decode(recording[3]);
  EXPECT_EQ(scan.cloud.size(), records.count - 2);
  ASSERT_TRUE(scan.cloud.has_times());
  EXPECT_NEAR(scan.stamp, recording[3].stamp.stamp, 1e-6);
  EXPECT_LT(*std::max_element(scan.cloud.times.begin(), scan.cloud.times.end()), 0.11f);
}

TEST(DriverTimesTraps, FirstSweepWithEpochInFloat32DoesNotSpoilTheOthers) {
  std::vector<StampedRecords> recording;
  for (int k = 0; k < 8; ++k) {
    const Spin spin{beams_deg(16, -15, 2), 0.1, 170, 360, true, kEpoch + 0.1 * k};
    const RecordField time{"time", FieldType::f32,
                           [&](const Shot& s) { return k == 0 ? s.time : s.time - spin.start; }};
    recording.push_back({{spin.start, std::nullopt}, records_of(shots_of(spin), {ring_field(), time})});
  }
  const ScanDecoder decoder(recording, {});
  EXPECT_FALSE(decoder.decode(recording[0]).cloud.has_times());
  EXPECT_TRUE(decoder.decode(recording[1]).cloud.has_times());
  EXPECT_NEAR(decoder.decode(recording[1]).stamp, kEpoch + 0.1, 1e-6);
}

TEST(DriverTimesTraps, VaryingLengthsShowThatStampsMarkTheEnd) {
  std::vector<StampedRecords> recording;
  double begin = kEpoch;
  for (int k = 0; k < 8; ++k) {
    const double covered = 360.0 + 4.0 * ((k * 5) % 8);
    const std::vector<Shot> shots = shots_of({beams_deg(16, -15, 2), 0.1, 170, covered, true, begin});
    const RecordField time{"time", FieldType::f32, [&](const Shot& s) { return s.time - begin; }};
    recording.push_back({{shots.back().time, std::nullopt}, records_of(shots, {ring_field(), time})});
    begin = shots.back().time + 1e-5;
  }
  const ScanDecoder decoder(recording, {});
  EXPECT_NE(decoder.decisions()[3].find("stamp marks its end"), std::string::npos) << decoder.decisions()[3];
  EXPECT_NEAR(decoder.decode(recording[0]).stamp, kEpoch, 1e-6);
}

TEST(DriverTimesTraps, NominalStampsGiveWayToAbsoluteTimes) {
  auto recording = recording_with(FieldType::f64, [](const Shot& s) { return s.time; });
  for (std::size_t k = 0; k < recording.size(); ++k) recording[k].stamp.stamp = 0.1 * double(k);
  const ScanDecoder decoder(recording, {.nominal_stamps = true, .deskewed = false});
  EXPECT_NEAR(decoder.decode(recording[2]).stamp, kEpoch + 0.2, 1e-6);
}

}  // namespace
}  // namespace tilth
