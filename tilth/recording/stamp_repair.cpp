#include <algorithm>
#include <cmath>

#include <tilth/recording/stamp_repair.hpp>

namespace tilth {
namespace {

constexpr double kLeastStep = 0.1;        ///< [steps] a sensor does not turn in less
constexpr double kGap = 1.5;              ///< [steps] from here on scans are missing in between
constexpr double kInPlace = 0.3;          ///< [steps] from where a scan is due
constexpr double kRoom = 0.6;             ///< [steps] a scan needs at least
constexpr double kLongestPause = 86400;   ///< [s] longer ones were made by a clock
constexpr double kPauseFromZero = 20.0;   ///< [steps] after a stamp of 0, which may mean that there is none
constexpr double kSaidPause = 1.0;        ///< [s] and five steps: a pause worth a word
constexpr double kSameLatency = 1.0;      ///< [s] between the first scans
constexpr std::size_t kRemembered = 256;  ///< readings, for those stored twice

/// The second of two readings `apart` scans apart may follow the first.
bool may_follow(const StampReading& a, const StampReading& b, const ScanPace& pace) {
  const double step = b.stamp - a.stamp;
  if (!(step > kLeastStep * pace.step() && step < kLongestPause)) return false;
  if (a.stamp == 0.0 && step > kPauseFromZero * pace.step()) return false;
  const bool both = a.arrival && b.arrival && pace.comparable();
  return !both || std::abs(*b.arrival - *a.arrival - step) < kSameLatency;
}

/// The first reading that most of those after it may follow; 0 where there is none.
std::size_t first_to_believe(std::span<const StampReading> window, const ScanPace& pace) {
  for (std::size_t k = 0; k + 1 < window.size(); ++k) {
    const auto after = window.subspan(k + 1);
    const auto following = std::count_if(after.begin(), after.end(),
                                         [&](const StampReading& b) { return may_follow(window[k], b, pace); });
    if (2 * std::size_t(following) >= after.size()) return k;
  }
  return 0;
}

}  // namespace

StampVerdict StampRepair::next(std::span<const StampReading> window) {
  if (!last_) return first_of(window);
  if (const StampReading* twin = twin_of(window[0])) {
    return {0, last_->stamp, "stored twice: its stamp and its points are those of scan " + std::to_string(twin->scan)};
  }
  if (const auto k = overtaken(window)) {
    findings_.put_back(window[*k].scan);
    return give(window[*k], window[*k].stamp + offset_, *k);
  }
  return in_line(window) ? give(window[0], window[0].stamp + offset_, 0) : mend(window);
}

/// [s] on its own word.
double StampRepair::step_to(const StampReading& reading) const {
  return reading.stamp + offset_ - last_->stamp;
}

std::optional<double> StampRepair::arrival_step(const StampReading& reading) const {
  if (!reading.arrival || !last_->reading.arrival) return std::nullopt;
  return *reading.arrival - *last_->reading.arrival;
}

const StampReading* StampRepair::twin_of(const StampReading& reading) const {
  const auto it = std::find_if(seen_.rbegin(), seen_.rend(),
                               [&](const StampReading& before) { return are_twins(before, reading); });
  return it == seen_.rend() ? nullptr : &*it;
}

/// The scan that is due now, where a later one was stored before it.
std::optional<std::size_t> StampRepair::overtaken(std::span<const StampReading> window) const {
  const double usual = pace_.step(), step = step_to(window[0]);
  if (!(step > kGap * usual && step < (double(kAhead) + 1.5) * usual)) return std::nullopt;
  for (std::size_t k = 1; k < window.size(); ++k) {
    if (std::abs(step_to(window[k]) - usual) < kInPlace * usual) return k;
  }
  return std::nullopt;
}

bool StampRepair::in_line(std::span<const StampReading> window) const {
  const double usual = pace_.step(), step = step_to(window[0]);
  if (!(step > kLeastStep * usual)) return false;
  if (step < kGap * usual) return true;
  if (step > kLongestPause || pace_.too_early(window[0].stamp + offset_, window[0].arrival)) return false;
  return std::none_of(window.begin() + 1, window.end(), [&](const StampReading& later) {
    return step_to(later) > kLeastStep * usual && later.stamp < window[0].stamp;
  });
}

/// The first reading after that to judge which follows the last scan on its own word.
std::optional<std::size_t> StampRepair::back_in_line(std::span<const StampReading> window) const {
  for (std::size_t k = 1; k < window.size(); ++k) {
    const double step = step_to(window[k]);
    const bool later = step > kLeastStep * pace_.step() && step < kLongestPause;
    if (later && !pace_.too_early(window[k].stamp + offset_, window[k].arrival)) return k;
  }
  return std::nullopt;
}

StampVerdict StampRepair::first_of(std::span<const StampReading> window) {
  const std::size_t anchor = first_to_believe(window, pace_);
  double stamp = window[anchor].stamp;
  if (!std::isfinite(stamp)) stamp = window[anchor].arrival.value_or(0.0);
  for (std::size_t k = anchor; k > 0; --k) {
    const bool both = window[k].arrival && window[k - 1].arrival;
    stamp -= pace_.due(both ? std::optional(*window[k].arrival - *window[k - 1].arrival) : std::nullopt);
  }
  if (stamp != window[0].stamp) findings_.mended(window[0].scan, window[0].stamp, stamp);
  return give(window[0], stamp, 0);
}

StampVerdict StampRepair::mend(std::span<const StampReading> window) {
  const StampReading& reading = window[0];
  const std::optional<std::size_t> good = back_in_line(window);
  if (!good) return set_clock(window);
  const double usual = pace_.step(), places = double(*good) + 1.0, whole = step_to(window[*good]);
  if (whole < kRoom * usual * places) {  // the scans after it leave no room: did the recorder have the time for it?
    const std::optional<double> arrivals = arrival_step(window[*good]);
    const bool told = arrivals && pace_.comparable();
    if (!told || *arrivals > kRoom * usual * places) return set_clock(window);
    return {0, last_->stamp, "it comes too late: the scans before and after it follow one another without it"};
  }
  const bool even = whole < kGap * usual * places;
  const double step = even ? whole / places : std::min(pace_.due(arrival_step(reading)), whole - kRoom * usual);
  const double stamp = last_->stamp + step;
  findings_.mended(reading.scan, reading.stamp, stamp);
  return give(reading, stamp, 0);
}

/// The stamp that is due; where those after go on from the recorded one, its clock was set.
StampVerdict StampRepair::set_clock(std::span<const StampReading> window) {
  const StampReading& reading = window[0];
  const double step = pace_.due(arrival_step(reading)), stamp = last_->stamp + step;
  const bool goes_on = window.size() > 1 && may_follow(reading, window[1], pace_);
  if (goes_on) {
    findings_.clock_set(reading.scan, reading.stamp + offset_ - stamp);
    offset_ = stamp - reading.stamp;
  } else {
    findings_.mended(reading.scan, reading.stamp, stamp);
  }
  return give(reading, stamp, 0);
}

StampVerdict StampRepair::give(const StampReading& reading, double stamp, std::size_t take) {
  if (last_) {
    const double step = stamp - last_->stamp;
    if (step > std::max(kSaidPause, 5.0 * pace_.step())) findings_.pause(last_->reading.scan, step);
    pace_.add(stamp, step, reading.arrival, arrival_step(reading));
  } else {
    pace_.add(stamp, 0.0, reading.arrival, std::nullopt);
  }
  if (seen_.size() == kRemembered) seen_.pop_front();
  seen_.push_back(reading);
  last_ = Given{reading, stamp};
  return {take, stamp, ""};
}

std::vector<std::optional<double>> repaired_stamps(std::span<const StampReading> readings) {
  StampRepair repair(readings);
  std::vector<StampReading> waiting(readings.begin(), readings.end());
  std::vector<std::size_t> places(readings.size());
  for (std::size_t k = 0; k < places.size(); ++k) places[k] = k;
  std::vector<std::optional<double>> stamps(readings.size());
  while (!waiting.empty()) {
    const std::size_t ahead = std::min(waiting.size(), StampRepair::kAhead + 1);
    const StampVerdict verdict = repair.next(std::span(waiting).first(ahead));
    if (verdict.left_out.empty()) stamps[places[verdict.take]] = verdict.stamp;
    waiting.erase(waiting.begin() + std::ptrdiff_t(verdict.take));
    places.erase(places.begin() + std::ptrdiff_t(verdict.take));
  }
  return stamps;
}

}  // namespace tilth
