// Clocks that wrap, run free, stand still and jump; GPS sentences; dates.
#include <cmath>
#include <sensor/made_packets.hpp>

#include <gtest/gtest.h>

#include <tilth/sensor/device_packet.hpp>
#include <tilth/sensor/packet_clock.hpp>
#include <tilth/sensor/utc.hpp>

namespace tilth {
namespace {

constexpr double kStep = 1e-3;

std::vector<ClockReading> readings(double sensor, std::optional<double> arrival, std::size_t count, double wrap) {
  std::vector<ClockReading> all;
  for (std::size_t k = 0; k < count; ++k) {
    const double t = double(k) * kStep;
    all.push_back({std::fmod(sensor + t, wrap), std::nullopt});
    if (arrival) all.back().arrival = *arrival + t + 1e-4 * double(k % 7);  // jitter
  }
  return all;
}

std::vector<double> times(PacketClock& clock, const std::vector<ClockReading>& readings) {
  std::vector<double> all;
  for (const ClockReading& reading : readings) all.push_back(clock.time(reading).value_or(NAN));
  return all;
}

void expect_even(const std::vector<double>& times, double first) {
  for (std::size_t k = 0; k < times.size(); ++k) ASSERT_NEAR(times[k], first + double(k) * kStep, 1e-6) << k;
}

TEST(PacketClock, GoesOnWhereTheSensorsWraps) {
  for (const double wrap : {1.0, 3600.0}) {
    const auto all = readings(wrap - 0.5, std::nullopt, 1000, wrap);
    PacketClock clock(all, {wrap, kStep, false, {}});
    expect_even(times(clock, all), wrap - 0.5);
    EXPECT_EQ(clock.jumps(), 0U);
  }
}

TEST(PacketClock, TakesTheHourOfTheReceiverWhereBothAgree) {
  const auto all = readings(3599.9, 7200.0 * 1000 + 3599.95, 300, 3600.0);
  PacketClock clock(all, {3600.0, kStep, false, {}});
  expect_even(times(clock, all), 7200.0 * 1000 + 3599.9);
}

TEST(PacketClock, IsSetByTheEarliestArrivalWhereItRunsFree) {
  const auto all = readings(1234.0, 1.7e9, 300, 3600.0);
  PacketClock clock(all, {3600.0, kStep, false, {}});
  expect_even(times(clock, all), 1.7e9);
  EXPECT_NE(clock.decision().find("runs free"), std::string::npos);
}

TEST(PacketClock, TakesTheDateOfAMark) {
  const auto hourly = readings(1200.25, 5.0, 300, 3600.0);
  PacketClock clock(hourly, {3600.0, kStep, false, ClockTraits::Mark{100, 7200.0 * 9 + 1200.0}});
  expect_even(times(clock, hourly), 7200.0 * 9 + 1200.25);
  const auto secondly = readings(0.9, std::nullopt, 1500, 1.0);
  PacketClock second(secondly, {1.0, kStep, false, ClockTraits::Mark{1400, 1700000002.0 + 0.5}});
  expect_even(times(second, secondly), 1700000000.9);
}

TEST(PacketClock, CountsPacketsOrArrivalsWhereTheSensorsStandsStill) {
  std::vector<ClockReading> all(10, {0.0, std::nullopt});
  PacketClock counting(all, {3600.0, kStep, false, {}});
  expect_even(times(counting, all), 0.0);
  for (std::size_t k = 0; k < all.size(); ++k) all[k].arrival = 50.0 + 2e-3 * double(k);
  PacketClock arriving(all, {3600.0, kStep, false, {}});
  EXPECT_DOUBLE_EQ(times(arriving, all).back(), 50.018);
}

TEST(PacketClock, NeverJumpsBackNorFarAhead) {
  auto all = readings(100.0, 1000.0, 600, 3600.0);
  for (std::size_t k = 300; k < 600; ++k) all[k].sensor += 500.0;  // set by a GPS that found its fix
  for (std::size_t k = 450; k < 600; ++k) all[k].sensor -= 550.0;
  PacketClock clock(all, {3600.0, kStep, false, {}});
  const std::vector<double> t = times(clock, all);
  for (std::size_t k = 1; k < t.size(); ++k) {
    ASSERT_GT(t[k], t[k - 1]);
    ASSERT_LT(t[k] - t[k - 1], 3e-3) << k;
  }
  EXPECT_EQ(clock.jumps(), 2U);
}

TEST(PacketClock, AGapThatBothClocksSeeIsAGap) {
  auto all = readings(100.0, 1000.0, 600, 3600.0);
  for (std::size_t k = 300; k < 600; ++k) all[k].sensor += 40.0, *all[k].arrival += 40.0;
  PacketClock clock(all, {3600.0, kStep, false, {}});
  EXPECT_NEAR(times(clock, all)[300], 1000.0 + 0.3 + 40.0, 1e-6);
  EXPECT_EQ(clock.jumps(), 0U);
}

std::vector<ClockReading> with_heads(std::vector<ClockReading> all, std::size_t elsewhere) {
  for (std::size_t k = 0; k < all.size(); ++k) all[k].next_head = k != elsewhere;
  return all;
}

TEST(PacketClock, IsNotLedAstrayByAReceiverThatIsSet) {
  for (const double by : {7200.0, -7200.0, 1800.0, 19800.0, 7300.0, -3.5, 1.6e9}) {
    for (const ClockTraits& traits : {ClockTraits{3600.0, kStep, false, {}}, ClockTraits{0.0, kStep, true, {}},
                                      ClockTraits{1.0, kStep, false, {}}}) {
      SCOPED_TRACE(std::to_string(by) + " with wrap " + std::to_string(traits.wrap));
      auto all = readings(traits.absolute ? 1.7e9 : 0.7, 1.7e9, 600, traits.wrap > 0.0 ? traits.wrap : 1e12);
      for (std::size_t k = 300; k < 600; ++k) *all[k].arrival += by;
      all = with_heads(std::move(all), 1000);
      PacketClock clock(all, traits);
      const std::vector<double> t = times(clock, all);
      expect_even(t, t[0]);
      EXPECT_EQ(clock.receiver_jumps(), 1U);
      EXPECT_EQ(clock.jumps(), 0U);
    }
  }
}

TEST(PacketClock, TakesTheShorterGapWhereTheReceiverIsSetMeanwhile) {
  auto all = readings(100.0, 1.7e9, 600, 3600.0);
  for (std::size_t k = 300; k < 600; ++k) all[k].sensor += 5.0, *all[k].arrival += 7305.0;
  PacketClock clock(all, {3600.0, kStep, false, {}});
  const std::vector<double> t = times(clock, all);
  EXPECT_NEAR(t[300] - t[299], 5.0 + kStep, 1e-6);
}

TEST(PacketClock, WithoutAReceiverTakesAJumpForASetClockWhereTheHeadGoesOn) {
  for (const double by : {7200.0, -7200.0, 18.0, -0.25}) {
    auto all = readings(1.7e9, std::nullopt, 600, 1e12);
    for (std::size_t k = 300; k < 600; ++k) all[k].sensor += by;
    PacketClock set(all, {0.0, kStep, true, {}});
    expect_even(times(set, with_heads(all, 1000)), 1.7e9);
    EXPECT_EQ(set.jumps(), 1U);
  }
  auto all = readings(1.7e9, std::nullopt, 600, 1e12);
  for (std::size_t k = 300; k < 600; ++k) all[k].sensor += 18.0;
  PacketClock gap(all, {0.0, kStep, true, {}});
  EXPECT_NEAR(times(gap, with_heads(all, 300))[300], 1.7e9 + 18.3, 1e-6) << "the head turned meanwhile";
}

TEST(PacketClock, OfAnotherTimeZoneIsMovedToTheReceiversHour) {
  for (const double zone : {8.0, -7.0, 5.5}) {
    const auto all = readings(1.7e9 + zone * 3600.0, 1.7e9 + 0.01, 300, 1e12);
    PacketClock clock(all, {0.0, kStep, true, {}});
    expect_even(times(clock, all), 1.7e9);
    EXPECT_NE(clock.decision().find(" h off the receiver's"), std::string::npos) << clock.decision();
  }
  for (const double off : {37.0, 1000.0, 86400.0}) {  // leap seconds, another fault: the sensor's date stays
    const auto all = readings(1.7e9 + off, 1.7e9 + 0.01, 300, 1e12);
    PacketClock clock(all, {0.0, kStep, true, {}});
    expect_even(times(clock, all), 1.7e9 + off);
  }
}

TEST(PositionPacket, TellsTheTimeOfItsGpsSentence) {
  MadePacket packet(512);
  packet.little(198, 393'210'381, 4);
  packet.text(206, "$GPRMC,220632,A,3707.8324,N,12139.2864,W,000.0,144.7,111212,013.8,E,D*09\r\n");
  const PositionInfo info = parse_position_packet(packet.bytes());
  EXPECT_DOUBLE_EQ(info.since_hour, 393.210381);
  EXPECT_EQ(info.utc, 1355263592.0);
  packet.text(206, "$GPRMC,220632,V,");
  EXPECT_FALSE(parse_position_packet(packet.bytes()).utc) << "no fix";
  packet.text(206, "$GPRMC,2206");
  EXPECT_FALSE(parse_position_packet(MadePacket(512).bytes()).utc);
  EXPECT_EQ(info.pulse, PulseState::absent);
  packet.byte(202, 2);
  EXPECT_EQ(parse_position_packet(packet.bytes()).pulse, PulseState::locked);
  packet.byte(202, 4);
  EXPECT_FALSE(parse_position_packet(packet.bytes()).pulse);
}

TEST(UtcSeconds, CountsFrom1970AndRefusesWhatIsNoDate) {
  EXPECT_EQ(utc_seconds({2000, 1, 1, 0, 0, 0.0}), 946684800.0);
  EXPECT_EQ(utc_seconds({2024, 2, 29, 23, 59, 59.5}), 1709251199.5);
  EXPECT_FALSE(utc_seconds({2026, 0, 4, 5, 6, 7.0}));
  EXPECT_FALSE(utc_seconds({2026, 3, 4, 24, 6, 7.0}));
  EXPECT_FALSE(utc_seconds({1999, 3, 4, 5, 6, 7.0}));
}

}  // namespace
}  // namespace tilth
