#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <limits>

#include <tilth/sensor/packet_clock.hpp>

namespace tilth {
namespace {

constexpr double kAgreement = 2.0;    ///< [s] between clocks that show the same time
constexpr double kLargestStep = 1.0;  ///< [s] a larger one, or one back, is a jump where the arrivals tell another
constexpr double kEvenly = 0.999;     ///< [steps] at least between packets timed by their arrival
constexpr double kHalfHour = 1800.0;  ///< [s]
constexpr double kTimeZones = 14 * 3600.0;  ///< [s] between a clock of any of them and UTC
constexpr double kOnePacket = 0.5;          ///< [steps] a packet this near to the next place is the next one
constexpr double kMostLate = 0.5;           ///< [s] a packet this much before the last one was overtaken on its way

std::string seconds(double value) {
  char text[48];
  std::snprintf(text, sizeof text, "%.3f s", value);
  return text;
}

/// The multiple of `step` nearest to `value`.
double nearest_multiple(double value, double step) {
  return step * std::round(value / step);
}

}  // namespace

PacketClock::PacketClock(std::span<const ClockReading> first, const ClockTraits& traits) : traits_(traits) {
  assert(!first.empty() && traits.step > 0.0);
  const auto same = [&](const ClockReading& r) { return r.sensor == first.front().sensor; };
  still_ = first.size() > 2 && std::all_of(first.begin(), first.end(), same);
  double arrival_offset = std::numeric_limits<double>::infinity();
  std::vector<double> running;
  for (const ClockReading& reading : first) {
    const std::size_t sets = receiver_jumps_;
    const std::optional<double> t = advance(reading);
    if (receiver_jumps_ != sets) arrival_offset = std::numeric_limits<double>::infinity();  // it is right from now on
    if (t && reading.arrival) arrival_offset = std::min(arrival_offset, *reading.arrival - *t);
    running.push_back(t.value_or(*last_));
  }
  base_ = 0.0, jumps_ = 0, receiver_jumps_ = 0, last_.reset(), last_arrival_.reset();
  anchor(running, arrival_offset);
}

void PacketClock::anchor(std::span<const double> running, double arrival_offset) {
  const bool arrivals = std::isfinite(arrival_offset);
  if (still_) {
    decision_ = arrivals ? "stamps: of the receiver's clock, because the sensor's stands still"
                         : "stamps: ASSUMED from the order of the packets, because the sensor's clock stands still";
    return;
  }
  if (traits_.absolute || set_by_mark(running)) {
    if (traits_.absolute) decision_ = "stamps: of the sensor's clock, which tells the date";
    if (arrivals) match_hours(arrival_offset);
    return;
  }
  if (!arrivals) {
    decision_ = "stamps: of the sensor's clock, beginning at " + seconds(running.front()) + "; nothing tells the date";
    return;
  }
  const bool hourly = traits_.wrap > kAgreement;  // time zones are whole half hours apart
  const double whole = hourly ? nearest_multiple(arrival_offset, std::min(traits_.wrap, kHalfHour)) : 0.0;
  const bool agree = hourly && std::abs(arrival_offset - whole) <= kAgreement;
  runs_free_ = !agree;
  offset_ = agree ? whole : arrival_offset;
  decision_ = agree ? "stamps: of the sensor's clock, the hour from the receiver's"
                    : "stamps: of the sensor's clock, which runs free; set to the receiver's by the earliest arrival";
}

/// The date of the device packets, where the sensor's clock agrees with them.
bool PacketClock::set_by_mark(std::span<const double> running) {
  if (!traits_.mark || traits_.wrap <= 0.0 || traits_.mark->reading >= running.size()) return false;
  const double difference = traits_.mark->utc - running[traits_.mark->reading];
  const double whole = nearest_multiple(difference, traits_.wrap);
  if (std::abs(difference - whole) > kAgreement) return false;
  offset_ = whole;
  decision_ = "stamps: of the sensor's clock, the date from its device packets";
  return true;
}

/// A date that is whole half hours off the receiver's is that of another time zone: the receiver's is taken.
void PacketClock::match_hours(double arrival_offset) {
  const double difference = arrival_offset - offset_, whole = nearest_multiple(difference, kHalfHour);
  if (whole == 0.0 || std::abs(whole) > kTimeZones || std::abs(difference - whole) > kAgreement) return;
  offset_ += whole;
  char text[64];
  std::snprintf(text, sizeof text, "; it is %.1f h off the receiver's and moved by as much", std::abs(whole) / 3600.0);
  decision_ += text;
}

std::optional<double> PacketClock::time(const ClockReading& reading) {
  const std::optional<double> t = advance(reading);
  return t ? std::optional(*t + offset_) : std::nullopt;
}

/// The receiver's time, which may be set: then the head tells.
double PacketClock::stood_still(const ClockReading& reading) {
  const double next = last_ ? *last_ + traits_.step : reading.arrival.value_or(0.0);
  if (!reading.arrival || !last_) return next;
  const double since = last_arrival_ ? *reading.arrival - *last_arrival_ : 0.0;
  if (std::abs(since) > kLargestStep && reading.next_head.value_or(false)) {
    ++receiver_jumps_;
    base_ = next - *reading.arrival;
  }
  return std::max(*reading.arrival + base_, *last_ + kEvenly * traits_.step);  // packets handed over together
}

/// [s] of the next packet on the running clock; nothing where it repeats or comes after a later one.
std::optional<double> PacketClock::next_time(const ClockReading& reading) {
  const bool arrivals = reading.arrival && last_arrival_;
  const double expected = arrivals ? *reading.arrival - *last_arrival_ : traits_.step;
  const double wrap = traits_.wrap, raw = reading.sensor + base_;
  const double least = wrap > 0.0 ? raw - wrap * std::floor((raw - *last_) / wrap) : raw;
  const bool one_packet = std::abs(least - *last_ - traits_.step) < kOnePacket * traits_.step;
  if (one_packet && (wrap <= 0.0 || wrap > kAgreement || reading.next_head.value_or(!arrivals))) {
    receiver_jumps_ += arrivals && std::abs(expected - (least - *last_)) > kLargestStep ? 1 : 0;
    return least;
  }
  const double near = wrap > 0.0 ? raw + nearest_multiple(expected - (raw - *last_), wrap) : raw;
  const double step = near - *last_;
  const bool next_head = reading.next_head.value_or(false);
  if (step <= 0.0 && step > -kMostLate) {
    if (step == 0.0 || !next_head) return std::nullopt;
    ++jumps_;
    return *last_ + traits_.step;
  }
  const bool both = arrivals ? std::abs(step - expected) <= kLargestStep : step <= kLargestStep || !next_head;
  return step > 0.0 && both ? near : by_one_clock(least, expected);
}

/// Where the clocks differ, one of them was set: the packet comes soon after the last, or after the shorter gap.
double PacketClock::by_one_clock(double sensor, double expected) {
  const double step = sensor - *last_;
  const bool receiver_runs = expected >= 0.0 && expected <= kLargestStep;
  const bool sensor_runs = step > 0.0 && (step <= kLargestStep || expected < 0.0);
  if (sensor_runs || (!receiver_runs && step > 0.0 && step < expected)) {
    ++receiver_jumps_;
    return sensor;
  }
  ++jumps_;
  return *last_ + std::max(expected, traits_.step);
}

std::optional<double> PacketClock::advance(const ClockReading& reading) {
  double t = still_ ? stood_still(reading) : reading.sensor + base_;
  if (last_ && !still_) {
    const std::optional<double> next = next_time(reading);
    if (!next) return std::nullopt;
    t = *next;
    base_ = t - reading.sensor;
  }
  last_ = t;
  last_arrival_ = reading.arrival;
  return t;
}

}  // namespace tilth
