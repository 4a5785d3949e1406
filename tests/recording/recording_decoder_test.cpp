// Fields that change on the way.
#include <algorithm>
#include <io/expect_error.hpp>
#include <sensor/spinning_lidar.hpp>

#include <gtest/gtest.h>

#include <tilth/recording/recording_decoder.hpp>

namespace tilth {
namespace {

Spin spin_of(int scan) {
  return {beams_deg(16, -15, 2), 0.1, 170.0 - 2.0 * scan, 362, true, 0.1 * 362 / 360 * scan};
}

/// `lag` [s] from the first point to the stamp; times count from there.
StampedRecords record(int scan, bool whole, double lag = 0.0) {
  const Spin spin = spin_of(scan);
  const double stamp = spin.start + lag;
  const RecordField time{"time", FieldType::f32, [stamp](const Shot& s) { return s.time - stamp; }};
  std::vector<RecordField> fields{intensity_field()};
  if (whole) fields = {intensity_field(), ring_field(), time};
  return {{stamp, std::nullopt}, records_of(shots_of(spin), fields)};
}

std::vector<StampedRecords> records_from(int first, int count, bool whole, double lag = 0.0) {
  std::vector<StampedRecords> all;
  for (int k = first; k < first + count; ++k) all.push_back(record(k, whole, lag));
  return all;
}

void expect_measured(const Scan& scan, int k, double tolerance = 4e-4) {
  const std::vector<Shot> truth = shots_of(spin_of(k));
  ASSERT_EQ(scan.cloud.size(), truth.size());
  ASSERT_TRUE(scan.cloud.has_rings() && scan.cloud.has_times());
  EXPECT_NEAR(scan.stamp, truth.front().time, 2e-4);
  for (std::size_t i = 0; i < truth.size(); i += 31) {
    ASSERT_EQ(scan.cloud.rings[i], truth[i].ring);
    ASSERT_NEAR(scan.stamp + double(scan.cloud.times[i]), truth[i].time, tolerance);
  }
}

TEST(RecordingDecoder, DerivesWhatIsMissingFromAScanOn) {
  for (const double lag : {0.0, 0.1}) {  // stamps at the first point, or at the last as velodyne_pointcloud has them
    std::vector<StampedRecords> first = records_from(0, 8, true, lag);
    RecordingDecoder decoder(first, {});
    for (int k = 0; k < 8; ++k) expect_measured(decoder.decode(first[std::size_t(k)]), k);
    std::vector<StampedRecords> later = records_from(8, 8, false, lag);
    for (StampedRecords& r : later) decoder.mend(r);
    ASSERT_FALSE(decoder.knows(later.front()));
    decoder.learn(later);
    ASSERT_TRUE(decoder.knows(later.front()));
    for (int k = 8; k < 16; ++k) expect_measured(decoder.decode(later[std::size_t(k - 8)]), k);
    const std::vector<std::string> notices = decoder.notices();
    ASSERT_EQ(notices.size(), 1u);
    EXPECT_NE(notices[0].find("from scan 8 on there is no field for rings, no field for times"), std::string::npos)
        << notices[0];
    EXPECT_NE(notices[0].find("16 beams"), std::string::npos) << notices[0];
  }
}

TEST(RecordingDecoder, ReadsFieldsThatAppearOnTheWay) {
  std::vector<StampedRecords> first = records_from(0, 8, false);
  RecordingDecoder decoder(first, {});
  for (int k = 0; k < 8; ++k) expect_measured(decoder.decode(first[std::size_t(k)]), k);
  const std::vector<StampedRecords> later = records_from(8, 3, true);
  decoder.learn(later);
  for (int k = 8; k < 11; ++k) expect_measured(decoder.decode(later[std::size_t(k - 8)]), k);
}

TEST(RecordingDecoder, MixedFromTheStartDecidesEachAlone) {
  std::vector<StampedRecords> first;
  for (int k = 0; k < 8; ++k) first.push_back(record(k, k % 2 == 0));
  RecordingDecoder decoder(first, {});
  EXPECT_FALSE(decoder.knows(first[1]));
  decoder.learn(std::span(first).subspan(1));  // of scans with times among them, which tell how long a turn takes
  for (int k = 0; k < 8; ++k) expect_measured(decoder.decode(first[std::size_t(k)]), k);
}

TEST(RecordingDecoder, NamesWhatIsMissingInAScan) {
  std::vector<StampedRecords> first = records_from(0, 2, true);
  RecordingDecoder decoder(first, {});
  StampedRecords cut = record(2, true);
  std::erase_if(cut.records.fields, [](const PointField& field) { return field.name == "z"; });
  decoder.mend(cut);
  EXPECT_TRUE(decoder.knows(cut));
  expect_error([&] { decoder.decode(cut); }, {"field z", "is missing"});
}

}  // namespace
}  // namespace tilth
