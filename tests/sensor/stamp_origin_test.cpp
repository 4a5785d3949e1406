// Which clock stamps are taken from.
#include <cmath>

#include <gtest/gtest.h>

#include <tilth/sensor/stamp_origin.hpp>

namespace tilth {
namespace {

std::vector<StampReading> readings(double (*stamp)(double), bool recorder, double rate = 10.0) {
  std::vector<StampReading> all;
  for (std::size_t k = 0; k < 8; ++k) {
    const double t = 1700000000.33 + double(k) / rate;
    all.push_back({k, stamp(t), recorder ? std::optional(t + 0.12) : std::nullopt, 1000 + k});
  }
  return all;
}

double zero(double) {
  return 0.0;
}
double whole(double t) {
  return std::floor(t);
}
double tenths(double t) {
  return std::floor(t * 10.0) / 10.0;
}
double own(double t) {
  return t;
}
double stuck(double) {
  return 41.7;
}

TEST(StampOrigin, IsTheirOwnWhereTheyTellScansApart) {
  for (const bool recorder : {true, false}) {
    EXPECT_EQ(decide_stamp_origin(readings(own, recorder)).origin, StampOrigin::own);
    EXPECT_EQ(decide_stamp_origin(readings(tenths, recorder)).origin, StampOrigin::own);
    EXPECT_EQ(decide_stamp_origin(readings(whole, recorder, 1.0)).origin, StampOrigin::own) << "one a second";
  }
  auto once = readings(own, true);
  once[3].stamp = once[2].stamp;
  EXPECT_EQ(decide_stamp_origin(once).origin, StampOrigin::own);
  EXPECT_TRUE(decide_stamp_origin(once).sentence.empty());
}

TEST(StampOrigin, IsTheRecorderWhereTheyDoNot) {
  const auto decided = [](double (*stamp)(double), double rate) {
    return decide_stamp_origin(readings(stamp, true, rate));
  };
  EXPECT_EQ(decided(whole, 10.0).origin, StampOrigin::recorder);
  EXPECT_NE(decided(whole, 10.0).sentence.find("are whole seconds"), std::string::npos);
  EXPECT_EQ(decided(tenths, 20.0).origin, StampOrigin::recorder);
  EXPECT_EQ(decided(stuck, 10.0).origin, StampOrigin::recorder);
  EXPECT_NE(decided(stuck, 10.0).sentence.find("stand still"), std::string::npos);
  EXPECT_NE(decided(zero, 10.0).sentence.find("were never set"), std::string::npos);
}

TEST(StampOrigin, IsTheOrderWhereNoClockTellsScansApart) {
  EXPECT_EQ(decide_stamp_origin(readings(zero, false)).origin, StampOrigin::order);
  auto both = readings(whole, true);
  for (StampReading& reading : both) reading.arrival = reading.stamp;
  const StampOriginDecision decision = decide_stamp_origin(both);
  EXPECT_EQ(decision.origin, StampOrigin::order);
  EXPECT_NE(decision.sentence.find("ASSUMED"), std::string::npos);
}

TEST(StampOrigin, IsNotTheirOwnWhereTheyRunBackwards) {
  const auto backwards = [](double t) { return 3.4e9 - t; };
  EXPECT_EQ(decide_stamp_origin(readings(backwards, true)).origin, StampOrigin::recorder);
  const StampOriginDecision assumed = decide_stamp_origin(readings(backwards, false));
  EXPECT_EQ(assumed.origin, StampOrigin::order);
  EXPECT_NE(assumed.sentence.find("run backwards"), std::string::npos) << assumed.sentence;
  std::vector<StampReading> once = readings(own, false);
  once[4].stamp -= 3.0;
  EXPECT_EQ(decide_stamp_origin(once).origin, StampOrigin::own) << "a single one is mended";
}

TEST(StampOrigin, OfScansStoredTwiceIsTheirOwn) {
  auto twice = readings(own, true);
  for (std::size_t k = 1; k < 8; k += 2) {
    twice[k] = twice[k - 1];
    *twice[k].arrival += 0.001;
  }
  EXPECT_EQ(decide_stamp_origin(twice).origin, StampOrigin::own);
}

TEST(StampOrigin, OfASensorAtRestWithoutNoiseIsTheRecorder) {
  auto alike = readings(whole, true);
  for (StampReading& reading : alike) reading.content = 7;
  EXPECT_EQ(decide_stamp_origin(alike).origin, StampOrigin::recorder);
}

TEST(StampOrigin, OfOneScanIsItsOwnIfItHasOne) {
  const auto one = [](double stamp) { return std::vector<StampReading>{{0, stamp, 1700000000.0, 1}}; };
  EXPECT_EQ(decide_stamp_origin(one(5.0)).origin, StampOrigin::own);
  EXPECT_EQ(decide_stamp_origin(one(0.0)).origin, StampOrigin::recorder);
}

}  // namespace
}  // namespace tilth
