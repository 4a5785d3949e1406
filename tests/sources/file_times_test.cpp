// Times of scans from the names of their files and from a list beside them.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <io/expect_error.hpp>

#include <gtest/gtest.h>

#include <tilth/sources/listed_times.hpp>
#include <tilth/sources/name_times.hpp>
#include <tilth/sources/time_unit.hpp>

namespace tilth {
namespace {

constexpr double kBegin = 899.0437;  // [s]

/// [ns] of scan k of a 10 Hz sensor that turns a little unevenly.
long long nanoseconds(std::size_t k, double begin = kBegin) {
  return std::llround((begin + 0.1 * double(k) + 0.0007 * std::sin(double(k))) * 1e9);
}

template <class Namer>
std::vector<std::string> named(const Namer& name, std::size_t count = 60) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < count; ++k) names.push_back(name(k));
  return names;
}

/// `name` of every scan gives its time.
template <class Namer>
void expect_times(const Namer& name, double begin, const std::string& said) {
  const auto times = times_in_names(named(name));
  ASSERT_TRUE(times) << name(0);
  for (std::size_t k = 0; k < 60; ++k)
    ASSERT_NEAR(times->times[k], double(nanoseconds(k, begin)) * 1e-9, 2e-3) << name(k);
  EXPECT_NE(times->decision.find(said), std::string::npos) << times->decision;
}

std::string pair(const char* format, long long nanoseconds, long long unit) {
  char text[64];
  std::snprintf(text, sizeof text, format, nanoseconds / 1'000'000'000, nanoseconds % 1'000'000'000 / unit);
  return text;
}

TEST(NameTimes, AreSecondsAndWhatFollowsThemWithOrWithoutZeros) {
  for (const double begin : {kBegin, 1700000000.0}) {
    expect_times([&](std::size_t k) { return pair("%lld.%09lld", nanoseconds(k, begin), 1); }, begin, "of the files");
    expect_times([&](std::size_t k) { return pair("%lld.%03lld", nanoseconds(k, begin), 1'000'000); }, begin, "files");
    expect_times([&](std::size_t k) { return pair("%lld.%lld", nanoseconds(k, begin), 1); }, begin,
                 "seconds and nanoseconds without leading zeros");
    expect_times([&](std::size_t k) { return pair("%lld.%lld", nanoseconds(k, begin), 1000); }, begin,
                 "microseconds without");
    expect_times([&](std::size_t k) { return pair("%lld.%lld", nanoseconds(k, begin), 1'000'000); }, begin,
                 "milliseconds without");
  }
  expect_times([](std::size_t k) { return pair("%lld_%lld", nanoseconds(k, 1.7e9), 1); }, 1.7e9, "nanoseconds without");
  expect_times([](std::size_t k) { return pair("cloud-%lld.%09lld", nanoseconds(k, 1.7e9), 1); }, 1.7e9, "files");
}

TEST(NameTimes, AreIntegersOfSmallerUnits) {
  const auto integer = [](double begin, long long unit) {
    return [=](std::size_t k) { return std::to_string(nanoseconds(k, begin) / unit); };
  };
  for (const double begin : {0.0437, kBegin, 1700000000.0}) {  // 8 to 11, 12, 19 digits of nanoseconds
    expect_times(integer(begin, 1), begin, "in nanoseconds");
    expect_times(integer(begin, 1000), begin, "in microseconds");
  }
  expect_times(integer(1700000000.0, 1'000'000), 1700000000.0, "in milliseconds");
  expect_times(
      [](std::size_t k) { return "n015__LIDAR_TOP__" + std::to_string(nanoseconds(k, 1.5e9) / 1000) + ".pcd"; }, 1.5e9,
      "in microseconds");
}

TEST(NameTimes, AreNotWhatCountsOrMeansSomethingElse) {
  const std::vector<std::vector<std::string>> others{{"000001", "000002", "000003"},
                                                     {"0", "100", "200"},
                                                     {"scan_1_2", "scan_1_3", "scan_2_1"},
                                                     {"run1_000123"},
                                                     {"1.2.3", "1.2.4", "1.2.5"},
                                                     {"20240501_120000"},
                                                     {"1700000000"},
                                                     {"a", "b"},
                                                     {"12345678", "3", "9999999"},
                                                     {"scan0.1", "scan0.2"}};
  for (const auto& names : others) EXPECT_FALSE(times_in_names(names)) << names[0];
  EXPECT_FALSE(times_in_names({}));
}

TEST(NameTimes, DecimalsWithoutTrailingZerosAreDecimals) {
  const std::vector<std::string> names{"1", "1.1", "1.2", "1.25", "1.3", "1.4"};
  EXPECT_EQ(times_in_names(names)->times, (std::vector<double>{1, 1.1, 1.2, 1.25, 1.3, 1.4}));
}

std::vector<std::string> counters(std::size_t count, std::size_t first = 0) {
  return named([&](std::size_t k) { return "scan_" + std::to_string(first + k); }, count);
}

std::vector<double> list(std::size_t count, double unit = 1.0, double begin = 0.0) {
  std::vector<double> times;
  for (std::size_t k = 0; k < count; ++k) {
    const double time = begin + 0.1 * double(k);
    times.push_back(unit == 1.0 ? time : std::round(time / unit));
  }
  return times;
}

TEST(ListedTimes, MayBeInAnyUnit) {
  for (const double begin : {0.0, 5.0, 1.7e9}) {
    for (const auto& [unit, name] :
         {std::pair{1e-9, ", in nanoseconds"}, {1e-6, ", in microseconds"}, {1e-3, ", in milliseconds"}}) {
      const auto listed = listed_times(list(60, unit, begin), counters(60), "times.txt", 0.0);
      ASSERT_TRUE(listed);
      EXPECT_EQ(listed->decision, name);
      for (std::size_t k = 0; k < 60; ++k) ASSERT_NEAR(listed->times[k], begin + 0.1 * double(k), 1e-6);
    }
  }
  const std::vector<double> seconds{0.0, 0.1037, 0.2, 0.31, 1.7, 33.3};
  const auto listed = listed_times(seconds, counters(6), "times.txt", 0.0);
  EXPECT_EQ(listed->times, seconds) << "as it stands, to the bit";
  EXPECT_EQ(listed->decision, "");
  EXPECT_EQ(unit_of_times(std::vector{1.7e18}).name, "nanoseconds");
  EXPECT_EQ(unit_of_times(std::vector{0.0, 40.0, 80.0}).name, "milliseconds") << "25 Hz";
  EXPECT_EQ(unit_of_times(std::vector{0.0, 7.0, 8.0, 300.0}).name, "seconds") << "scans chosen by hand";
}

TEST(ListedTimes, LongerThanTheFilesAreMatchedByNumber) {
  auto names = counters(60);
  names.erase(names.begin() + 20);
  const auto gap = listed_times(list(60), names, "times.txt", 0.0);
  EXPECT_NEAR(gap->times[19], 1.9, 1e-9);
  EXPECT_NEAR(gap->times[20], 2.1, 1e-9);
  EXPECT_NE(gap->decision.find("60 times for 59 scans, matched by the numbers"), std::string::npos);
  EXPECT_NEAR(listed_times(list(300), counters(40, 230), "", 0.0)->times[0], 23.0, 1e-9) << "a part of a recording";
  auto from_one = counters(60, 1);
  from_one.erase(from_one.begin() + 20);
  EXPECT_NEAR(listed_times(list(60), from_one, "", 0.0)->times[0], 0.0, 1e-9);
  const std::vector<std::string> words{"a", "b", "c"};
  const auto first = listed_times(list(5), words, "", 0.0);
  EXPECT_EQ(first->times.size(), 3u);
  EXPECT_EQ(first->decision, ", the first 3 of 5");
}

TEST(ListedTimes, ShorterThanTheFilesAreContinuedOrRefused) {
  const auto short_by_one = listed_times(list(59), counters(60), "times.txt", 0.0);
  EXPECT_NEAR(short_by_one->times[59], 5.9, 1e-6);
  EXPECT_NE(short_by_one->decision.find("CONTINUED"), std::string::npos);
  expect_error([] { listed_times(list(30), counters(60), "times.txt", 0.0); },
               {"times.txt", "30 times for 60 scans", "--rate"});
}

TEST(ListedTimes, InWholeSecondsAreSpreadEvenly) {
  std::vector<double> whole;
  for (std::size_t k = 0; k < 60; ++k) whole.push_back(std::floor(100.37 + 0.1003 * double(k)));
  const auto listed = listed_times(whole, counters(60), "times.txt", 0.0);
  ASSERT_TRUE(listed);
  for (std::size_t k = 1; k < 60; ++k) {
    EXPECT_NEAR(listed->times[k] - listed->times[k - 1], 0.1, 1e-9);
    EXPECT_NEAR(listed->times[k], 100.37 + 0.1003 * double(k), 0.15);
  }
  EXPECT_NE(listed->decision.find("stand still between scans"), std::string::npos);
  EXPECT_NEAR(
      listed_times(whole, counters(60), "", 5.0)->times[1] - listed_times(whole, counters(60), "", 5.0)->times[0], 0.2,
      1e-9)
      << "as the rate that is given";
}

TEST(ListedTimes, ThatRunBackwardsAreRefused) {
  std::vector<double> times = list(6);
  std::reverse(times.begin(), times.end());
  expect_error([&] { listed_times(times, counters(6), "times.txt", 0.0); }, {"times.txt", "runs backwards", "--rate"});
  times = list(6);
  std::swap(times[2], times[3]);
  EXPECT_TRUE(listed_times(times, counters(6), "times.txt", 0.0)) << "single ones are mended";
}

TEST(ListedTimes, ThatNeverAdvanceTellNothing) {
  EXPECT_FALSE(listed_times(std::vector<double>(60, 0.0), counters(60), "", 0.0));
  EXPECT_FALSE(listed_times(std::vector<double>(60, 1.7e9), counters(60), "", 10.0));
}

}  // namespace
}  // namespace tilth
