// What was looked at beforehand still comes, in its order, and so does what went wrong there.
#include <io/expect_error.hpp>
#include <run/scan_list.hpp>

#include <gtest/gtest.h>

#include <tilth/run/level_floor.hpp>
#include <tilth/sources/lookahead_source.hpp>

namespace tilth {
namespace {

std::vector<double> stamps_of(ScanSource& source) {
  std::vector<double> stamps;
  while (const std::optional<Scan> scan = source.next()) stamps.push_back(scan->stamp);
  return stamps;
}

TEST(LookaheadSource, GivesEveryScanOnceInItsOrder) {
  ScanList plain(small_scans(9));
  LookaheadSource source(std::make_unique<ScanList>(small_scans(9)), 0.35);
  EXPECT_EQ(source.ahead().size(), 5U) << "of 0, 0.1 ... 0.4 s";
  EXPECT_EQ(source.decisions(), std::vector<std::string>{"times are made up"});
  EXPECT_EQ(source.size(), 9U);
  EXPECT_EQ(stamps_of(source), stamps_of(plain));
  EXPECT_EQ(source.notices(), std::vector<std::string>{"a packet was lost"});
}

TEST(LookaheadSource, TakesWhatThereIsOfAShortOne) {
  LookaheadSource source(std::make_unique<ScanList>(small_scans(3)), 100);
  EXPECT_EQ(source.ahead().size(), 3U);
  EXPECT_EQ(stamps_of(source).size(), 3U);
}

TEST(LookaheadSource, TellsWhatWentWrongWhenItIsReached) {
  auto torn = std::make_unique<ScanList>(small_scans(9));
  torn->breaks_off_at = 2, torn->skips_at = 1;
  LookaheadSource source(std::move(torn), 100);
  EXPECT_EQ(source.skipped().size(), 1U);
  EXPECT_TRUE(source.next() && source.next());
  expect_error([&] { source.next(); }, {"list", "torn"});
}

TEST(LevelFloor, IsRefusedWhereTheScansShowNone) {
  MetreAScan odometry;
  expect_error([&] { floor_below(odometry, small_scans(5), Pose::Identity()); }, {"level", "5 scans", "no floor"});
  expect_error([&] { floor_below(odometry, {}, Pose::Identity()); }, {"level", "0 scans"});
}

}  // namespace
}  // namespace tilth
