// Bags and folders whose stamps are wrong, as a whole: every scan comes out, where it belongs, and what was done is
// said.
#include <cmath>
#include <fstream>
#include <io/temporary_folder.hpp>
#include <sensor/spinning_lidar.hpp>

#include <gtest/gtest.h>

#include <tilth/io/pcd.hpp>
#include <tilth/io/rosbag1_writer.hpp>
#include <tilth/messages/point_cloud2.hpp>
#include <tilth/sources/open_source.hpp>

namespace tilth {
namespace {

constexpr double kEpoch = 1700000000.0;
constexpr int kScans = 24;

/// [s] when scan k begins: a sensor that turns a little faster than ten times a second, from a fixed azimuth on.
double begin_of(int k) {
  return kEpoch + 0.3 + 0.0997 * k;
}

std::vector<Shot> shots(int scan, double period = 0.0997) {
  return shots_of({beams_deg(16, -15, 2), period, 170.0, 360, true, begin_of(scan), 400});
}

enum class Times { field, none };

PointRecords records(int scan, Times times) {
  const RecordField since{"time", FieldType::f32, [scan](const Shot& s) { return s.time - begin_of(scan); }};
  std::vector<RecordField> fields{intensity_field(), ring_field()};
  if (times == Times::field) fields.push_back(since);
  return records_of(shots(scan), fields);
}

using Clock = std::function<double(int scan)>;

/// A bag of clouds with these stamps, which the recorder has 15 to 25 ms after their ends.
void write_bag(const std::filesystem::path& path, const Clock& stamp, Times times, const Clock& recorder) {
  Rosbag1Writer bag(path);
  Connection connection;
  connection.topic = "/points";
  connection.type = kPointCloud2Type;
  connection.md5 = kPointCloud2Md5;
  connection.definition = kPointCloud2Definition;
  const std::uint32_t id = bag.add_connection(connection);
  for (int k = 0; k < kScans; ++k)
    bag.write(id, std::uint64_t(recorder(k) * 1e9),
              serialize_point_cloud2(PointCloud2{stamp(k), "lidar", records(k, times)}));
  bag.close();
}

double arrival(int k) {
  return begin_of(k) + 0.0997 + 0.015 + 0.005 * (k * 7 % 3);
}

struct Opened {
  std::vector<Scan> scans;
  std::string said;
  std::size_t skipped = 0;
};

Opened opened(const std::filesystem::path& path) {
  Opened result;
  const auto source = open_source(path.string(), {});
  while (auto scan = source->next()) result.scans.push_back(std::move(*scan));
  for (const std::string& sentence : source->decisions()) result.said += sentence + "\n";
  for (const std::string& sentence : source->notices()) result.said += sentence + "\n";
  result.skipped = source->skipped().size();
  return result;
}

/// All scans with their point times, `offset` [s] after the truth.
void expect_true(const Opened& recording, double offset, double tolerance, double spin_tolerance = 1e-3) {
  EXPECT_EQ(recording.skipped, 0u);
  ASSERT_EQ(recording.scans.size(), std::size_t(kScans));
  for (int k = 0; k < kScans; ++k) {
    const Scan& scan = recording.scans[std::size_t(k)];
    EXPECT_NEAR(scan.stamp, begin_of(k) + offset, tolerance) << k;
    ASSERT_TRUE(scan.cloud.has_times());
    EXPECT_NEAR(scan.cloud.times.back(), 0.0997, spin_tolerance);
  }
}

class StampsInContext : public testing::TestWithParam<Times> {
 protected:
  Opened bag(const Clock& stamp, const Clock& recorder = arrival) const {
    write_bag(folder_ / "a.bag", stamp, GetParam(), recorder);
    return opened(folder_ / "a.bag");
  }
  static bool says(const Opened& recording, const std::string& text) {
    return recording.said.find(text) != std::string::npos;
  }
  TemporaryFolder folder_;
};
INSTANTIATE_TEST_SUITE_P(PointTimes, StampsInContext, testing::Values(Times::field, Times::none),
                         [](const auto& p) { return p.param == Times::field ? "OfAField" : "Derived"; });

TEST_P(StampsInContext, OfASimulationFromExactlyZeroInABagOfToday) {
  const Opened recording = bag([](int k) { return begin_of(k) - begin_of(0); });
  expect_true(recording, -begin_of(0), 1e-6);
  EXPECT_FALSE(says(recording, "mended"));
}

TEST_P(StampsInContext, OfWholeSecondsOrNoneAreTheRecorders) {
  for (const auto& [clock, fault] :
       {std::pair<Clock, const char*>{[](int k) { return std::floor(begin_of(k)); }, "are whole"},
        {[](int) { return 0.0; }, "were never set"}}) {
    const Opened recording = bag(clock);
    expect_true(recording, 0.02, 0.012, 0.006);  // as the recorder's times jitter
    EXPECT_TRUE(says(recording, std::string("of the recorder, because those of the scans ") + fault)) << recording.said;
  }
}

TEST_P(StampsInContext, OfAClockThatIsSetGoOn) {
  for (const double by : {-3.0, 3.0}) {
    const Opened recording = bag([by](int k) { return begin_of(k) + (k >= 13 ? by : 0.0); });
    expect_true(recording, 0.0, 0.012);
    EXPECT_TRUE(says(recording, by < 0.0 ? "set back by 3.0" : "set forward by ")) << recording.said;
  }
}

TEST_P(StampsInContext, AloneWrongAreMended) {
  for (const int at : {0, 5, kScans - 1}) {
    for (const double wrong : {0.0, kEpoch + 5e4}) {
      const Opened recording = bag([=](int k) { return k == at ? wrong : begin_of(k); });
      expect_true(recording, 0.0, 0.006);
      EXPECT_TRUE(says(recording, "stamps: 1 was mended")) << recording.said;
    }
  }
}

TEST_P(StampsInContext, AreKeptWhereTheRecorderJumps) {
  const Opened recording = bag(begin_of, [](int k) { return arrival(k) + (k >= 9 ? 7200.0 : 0.0); });
  expect_true(recording, 0.0, 1e-6);
  EXPECT_FALSE(says(recording, "clock was set"));
}

TEST_P(StampsInContext, OfAFolderInNanosecondsWithAPause) {
  std::filesystem::create_directory(folder_ / "scans");
  std::ofstream times(folder_ / "times.txt");
  for (int k = 0; k < kScans; ++k) {
    write_pcd(folder_ / "scans" / (std::to_string(k) + ".pcd"), records(k, GetParam()));
    times << std::llround((begin_of(k) + (k >= 10 ? 30.0 : 0.0)) * 1e9) << "\n";
  }
  times.close();
  const Opened recording = opened(folder_ / "");
  ASSERT_EQ(recording.scans.size(), std::size_t(kScans));
  EXPECT_NEAR(recording.scans[20].stamp, begin_of(20) + 30.0, 1e-5);
  EXPECT_TRUE(says(recording, "in nanoseconds")) << recording.said;
  EXPECT_TRUE(says(recording, "pauses: no scans for 30.1 s after scan 9")) << recording.said;
}

TEST(StampsOfPoints, AreOfOneKindInARecordingWhoseTimesAreDerived) {
  const TemporaryFolder folder;
  for (int k = 0; k < kScans; ++k) {
    std::vector<Shot> all = shots(k);
    if (k == 6) std::erase_if(all, [](const Shot& s) { return std::abs(s.time - begin_of(6) - 0.05) > 0.001; });
    if (k == 7) std::reverse(all.begin(), all.begin() + long(all.size() / 2));
    char name[32];
    std::snprintf(name, sizeof name, "%.6f.pcd", begin_of(k));
    write_pcd(folder / name, records_of(all, {ring_field()}));
  }
  const Opened recording = opened(folder / "");
  ASSERT_EQ(recording.scans.size(), std::size_t(kScans));
  for (const Scan& scan : recording.scans) EXPECT_TRUE(scan.cloud.has_times());
  EXPECT_NEAR(recording.scans[6].stamp, begin_of(6) + 0.049, 1e-3) << "the few points of a covered sensor";
  const Scan& shuffled = recording.scans[7];
  std::vector<Shot> truth = shots(7);
  std::reverse(truth.begin(), truth.begin() + long(truth.size() / 2));
  for (std::size_t i = 0; i < truth.size(); i += 53)
    EXPECT_NEAR(shuffled.stamp + double(shuffled.cloud.times[i]), truth[i].time, 1e-3);
}

}  // namespace
}  // namespace tilth
