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
constexpr double kMostLate = 0.5;     ///< [s] a packet this much before the last one was overtaken on its way

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
    const std::optional<double> t = advance(reading);
    if (t && reading.arrival) arrival_offset = std::min(arrival_offset, *reading.arrival - *t);
    running.push_back(t.value_or(*last_));
  }
  base_ = 0.0, jumps_ = 0, last_.reset(), last_arrival_.reset();
  anchor(running, arrival_offset);
}

void PacketClock::anchor(std::span<const double> running, double arrival_offset) {
  const bool arrivals = std::isfinite(arrival_offset);
  if (still_) {
    decision_ = arrivals ? "stamps: of the receiver's clock, because the sensor's stands still"
                         : "stamps: ASSUMED from the order of the packets, because the sensor's clock stands still";
    return;
  }
  if (traits_.absolute) {
    decision_ = "stamps: of the sensor's clock, which tells the date";
    return;
  }
  if (traits_.mark && traits_.wrap > 0.0 && traits_.mark->reading < running.size()) {
    const double difference = traits_.mark->utc - running[traits_.mark->reading];
    const double whole = nearest_multiple(difference, traits_.wrap);
    if (std::abs(difference - whole) <= kAgreement) {
      offset_ = whole;
      decision_ = "stamps: of the sensor's clock, the date from its device packets";
      return;
    }
  }
  if (!arrivals) {
    decision_ = "stamps: of the sensor's clock, beginning at " + seconds(running.front()) + "; nothing tells the date";
    return;
  }
  const double whole = traits_.wrap > kAgreement ? nearest_multiple(arrival_offset, traits_.wrap) : 0.0;
  const bool agree = traits_.wrap > kAgreement && std::abs(arrival_offset - whole) <= kAgreement;
  offset_ = agree ? whole : arrival_offset;
  decision_ = agree ? "stamps: of the sensor's clock, the hour from the receiver's"
                    : "stamps: of the sensor's clock, which runs free; set to the receiver's by the earliest arrival";
}

std::optional<double> PacketClock::time(const ClockReading& reading) {
  const std::optional<double> t = advance(reading);
  return t ? std::optional(*t + offset_) : std::nullopt;
}

double PacketClock::stood_still(const ClockReading& reading) const {
  const double next = last_ ? *last_ + traits_.step : reading.arrival.value_or(0.0);
  if (!reading.arrival || !last_) return next;
  return std::max(*reading.arrival, *last_ + kEvenly * traits_.step);  // packets handed over together
}

std::optional<double> PacketClock::advance(const ClockReading& reading) {
  double t = still_ ? stood_still(reading) : reading.sensor + base_;
  if (last_ && !still_) {
    const bool arrivals = reading.arrival && last_arrival_;
    const double expected = *last_ + (arrivals ? *reading.arrival - *last_arrival_ : traits_.step);
    if (traits_.wrap > 0.0) t += nearest_multiple(expected - t, traits_.wrap);
    if (t <= *last_ && t > *last_ - kMostLate) return std::nullopt;
    const bool leap = arrivals && t - *last_ > kLargestStep && std::abs(t - expected) > kLargestStep;
    if (t <= *last_ || leap) {
      t = std::max(expected, *last_ + traits_.step);
      ++jumps_;
    }
    base_ = t - reading.sensor;
  }
  last_ = t;
  last_arrival_ = reading.arrival;
  return t;
}

}  // namespace tilth
