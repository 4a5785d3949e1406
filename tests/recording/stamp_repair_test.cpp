// Stamps in their context: what is mended, what is followed, what is believed.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <tilth/recording/stamp_repair.hpp>

namespace tilth {
namespace {

constexpr double kEpoch = 1700000000.25;
constexpr double kStep = 0.1;
constexpr double kLatency = 0.12;

enum class Recorder { none, jittery };

/// Scans of a 10 Hz sensor, which the recorder has a little late.
std::vector<StampReading> recording(std::size_t count, Recorder recorder, double begin = kEpoch) {
  std::vector<StampReading> readings;
  for (std::size_t k = 0; k < count; ++k) {
    StampReading reading{k, begin + kStep * double(k), std::nullopt, 1000 + k};
    if (recorder == Recorder::jittery) reading.arrival = kEpoch + kStep * double(k) + kLatency + 0.004 * double(k % 5);
    readings.push_back(reading);
  }
  return readings;
}

struct Repaired {
  std::vector<std::optional<double>> stamps;  ///< in the order given out
  std::vector<std::size_t> scans;             ///< likewise
  std::vector<std::string> said, left_out;
};

Repaired repaired(std::vector<StampReading> waiting) {
  const std::span<const StampReading> all(waiting);
  StampRepair repair(all.first(std::min<std::size_t>(8, all.size())));
  Repaired result;
  while (!waiting.empty()) {
    const StampVerdict verdict =
        repair.next(std::span(waiting).first(std::min(waiting.size(), StampRepair::kAhead + 1)));
    if (verdict.left_out.empty()) {
      result.stamps.push_back(verdict.stamp);
      result.scans.push_back(waiting[verdict.take].scan);
    } else {
      result.left_out.push_back(verdict.left_out);
    }
    waiting.erase(waiting.begin() + std::ptrdiff_t(verdict.take));
  }
  result.said = repair.findings().sentences();
  return result;
}

/// All scans, in order, stamped as if nothing had happened.
void expect_even(const Repaired& result, std::size_t count, double tolerance, double begin = kEpoch) {
  ASSERT_EQ(result.stamps.size(), count);
  for (std::size_t k = 0; k < count; ++k) {
    EXPECT_EQ(result.scans[k], k);
    EXPECT_NEAR(*result.stamps[k], begin + kStep * double(k), tolerance) << k;
  }
}

bool says(const Repaired& result, const std::string& text) {
  for (const std::string& sentence : result.said)
    if (sentence.find(text) != std::string::npos) return true;
  return false;
}

class Stamps : public testing::TestWithParam<Recorder> {};
INSTANTIATE_TEST_SUITE_P(WithAndWithoutARecorder, Stamps, testing::Values(Recorder::none, Recorder::jittery),
                         [](const auto& p) { return p.param == Recorder::none ? "Without" : "With"; });

TEST_P(Stamps, ThatCanBeAreKeptToTheBit) {
  auto readings = recording(40, GetParam());
  for (std::size_t k = 0; k < 40; ++k) readings[k].stamp += 0.013 * std::sin(double(k * k));  // a driver that jitters
  for (std::size_t k = 20; k < 40; ++k) {                                                     // ten scans are lost
    readings[k].stamp += 1.0;
    if (readings[k].arrival) *readings[k].arrival += 1.0;
  }
  const Repaired result = repaired(readings);
  ASSERT_EQ(result.stamps.size(), 40u);
  for (std::size_t k = 0; k < 40; ++k) EXPECT_EQ(*result.stamps[k], readings[k].stamp) << k;
  ASSERT_EQ(result.said.size(), 1u);
  EXPECT_TRUE(says(result, "pauses: no scans for 1.1 s after scan 19")) << result.said[0];
}

TEST_P(Stamps, OneThatCannotBeIsMendedByItsNeighbours) {
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  for (const std::size_t at : {0, 1, 7, 20, 38}) {
    for (const double wrong : {0.0, -5.0, 1.0, kEpoch - 3600.0, kEpoch + 1000.0, 9e9, nan, inf, -inf}) {
      SCOPED_TRACE("scan " + std::to_string(at) + " says " + std::to_string(wrong));
      if (at == 0 && GetParam() == Recorder::none && wrong == kEpoch - 3600.0) continue;  // it may be a pause
      auto readings = recording(40, GetParam());
      readings[at].stamp = wrong;
      const Repaired result = repaired(readings);
      expect_even(result, 40, 1e-3);
      EXPECT_TRUE(says(result, "stamps: 1 was mended")) << (result.said.empty() ? "nothing" : result.said[0]);
      EXPECT_EQ(result.said.size(), 1u);
    }
  }
}

TEST_P(Stamps, OneThatRepeatsIsMendedAndOneStoredTwiceIsLeftOut) {
  auto repeats = recording(40, GetParam());
  repeats[12].stamp = repeats[11].stamp;
  const Repaired mended = repaired(repeats);
  expect_even(mended, 40, 1e-3);
  EXPECT_TRUE(says(mended, "scan 12 was 1700000001.350000 s and is taken for 1700000001.450000 s")) << mended.said[0];

  auto twice = recording(40, GetParam());
  twice.insert(twice.begin() + 12, twice[11]);
  twice.insert(twice.begin() + 30, twice.begin() + 10, twice.begin() + 20);  // and a part of it anew
  const Repaired once = repaired(twice);
  expect_even(once, 40, 0.0);
  EXPECT_EQ(once.left_out.size(), 11u);
  EXPECT_TRUE(once.said.empty());
}

TEST_P(Stamps, AClockThatIsSetIsFollowed) {
  for (const double by : {-3.0, -0.1, -0.25, -1e9, 2e6}) {
    SCOPED_TRACE(by);
    auto readings = recording(60, GetParam());
    for (std::size_t k = 30; k < 60; ++k) readings[k].stamp += by;
    const Repaired result = repaired(readings);
    expect_even(result, 60, 0.011);
    EXPECT_TRUE(says(result, by < 0.0 ? "their clock was set back by" : "their clock was set forward by"));
    EXPECT_TRUE(says(result, "at scan 30"));
  }
}

TEST(StampsWithARecorder, ShowAClockThatIsSetForward) {
  for (const double by : {0.5, 3.0, 3600.0}) {
    auto readings = recording(60, Recorder::jittery);
    for (std::size_t k = 30; k < 60; ++k) readings[k].stamp += by;
    const Repaired result = repaired(readings);
    expect_even(result, 60, 0.011);
    EXPECT_TRUE(says(result, "set forward by")) << by;
  }
}

TEST(StampsWithARecorder, AreBelievedWhereItsOwnClockIsSetOrItIsLate) {
  auto readings = recording(80, Recorder::jittery);
  for (std::size_t k = 20; k < 80; ++k) *readings[k].arrival -= 3.0;
  for (std::size_t k = 40; k < 80; ++k) *readings[k].arrival += 700.0;
  for (std::size_t k = 50; k < 65; ++k) *readings[k].arrival = *readings[65].arrival - 0.001 * double(65 - k);
  const Repaired result = repaired(readings);
  expect_even(result, 80, 0.0);
  EXPECT_TRUE(result.said.empty()) << result.said[0];
}

TEST(StampsWithARecorder, PassOverScansThatComeTooLateToHaveAPlace) {
  auto readings = recording(60, Recorder::jittery);
  StampReading late = readings[10];
  readings.erase(readings.begin() + 10);
  late.arrival = *readings[39].arrival + 0.01;
  readings.insert(readings.begin() + 40, late);
  const Repaired result = repaired(readings);
  EXPECT_EQ(result.stamps.size(), 59u);
  ASSERT_EQ(result.left_out.size(), 1u);
  EXPECT_NE(result.left_out[0].find("too late"), std::string::npos);
}

TEST_P(Stamps, ScansStoredAfterALaterOneAreGivenOutInOrder) {
  auto readings = recording(40, GetParam());
  std::swap(readings[9], readings[10]);
  const StampReading first = readings[20];
  readings.erase(readings.begin() + 20);
  readings.insert(readings.begin() + 23, first);
  const Repaired result = repaired(readings);
  expect_even(result, 40, 0.0);
  EXPECT_TRUE(says(result, "2 scans were stored after a later one and put back in order: scan 9, 20"))
      << result.said[0];
}

TEST_P(Stamps, OfASimulationBeginAtExactlyZero) {
  const Repaired result = repaired(recording(40, GetParam(), 0.0));
  expect_even(result, 40, 0.0, 0.0);
  EXPECT_TRUE(result.said.empty());
}

TEST(StampsWithARecorder, ThatRunAtAnotherPaceAreBelieved) {
  auto readings = recording(60, Recorder::jittery, 0.0);  // a simulator at four times real time, which lost ten scans
  for (std::size_t k = 0; k < 60; ++k) readings[k].arrival = kEpoch + 0.025 * double(k);
  readings.erase(readings.begin() + 30, readings.begin() + 40);
  const Repaired result = repaired(readings);
  ASSERT_EQ(result.stamps.size(), 50u);
  for (std::size_t k = 0; k < 50; ++k) EXPECT_EQ(*result.stamps[k], readings[k].stamp);
}

TEST_P(Stamps, ThatStandStillForAWhileGoOn) {
  auto readings = recording(60, GetParam());
  for (std::size_t k = 20; k < 32; ++k) readings[k].stamp = readings[19].stamp;
  const Repaired result = repaired(readings);
  expect_even(result, 60, 0.011);
  EXPECT_TRUE(says(result, "12 were mended"));
}

TEST(RepairedStamps, AreThoseOfTheReadingsInTheirPlaces) {
  auto readings = recording(8, Recorder::jittery);
  std::swap(readings[3], readings[4]);
  readings[6].stamp = 0.0;
  const auto stamps = repaired_stamps(readings);
  ASSERT_EQ(stamps.size(), 8u);
  EXPECT_EQ(*stamps[3], kEpoch + 0.4);
  EXPECT_EQ(*stamps[4], kEpoch + 3 * kStep);
  EXPECT_NEAR(*stamps[6], kEpoch + 0.6, 1e-3);
}

}  // namespace
}  // namespace tilth
