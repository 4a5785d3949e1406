#include <algorithm>
#include <cmath>

#include <tilth/core/median.hpp>
#include <tilth/sensor/scan_pace.hpp>

namespace tilth {
namespace {

constexpr double kTwins = 0.02;          ///< [s] no sensor gives two scans in less
constexpr double kUsualStep = 0.1;       ///< [s]
constexpr std::size_t kRemembered = 15;  ///< steps, and latencies
constexpr double kSamePace = 0.1;        ///< by which the medians of both clocks' steps may differ, relative
constexpr double kNearWhole = 0.3;       ///< [steps] from a whole number of them
constexpr double kBurst = 0.5;           ///< [steps] nearer arrivals were held back on their way
constexpr double kLatencyJitter = 0.05;  ///< [s] at least by which a latency may be shorter than the ones before

void keep(std::vector<double>& values, double value) {
  if (values.size() == kRemembered) values.erase(values.begin());
  values.push_back(value);
}

}  // namespace

bool are_twins(const StampReading& a, const StampReading& b) {
  const bool apart = a.arrival && b.arrival && std::abs(*b.arrival - *a.arrival) > kTwins;
  return a.stamp == b.stamp && a.content == b.content && !apart;
}

ScanPace::ScanPace(std::span<const StampReading> first) {
  for (std::size_t k = 1; k < first.size(); ++k) {
    const double step = first[k].stamp - first[k - 1].stamp;
    if (std::isfinite(step) && step > 0.0) keep(steps_, step);
    if (!first[k].arrival || !first[k - 1].arrival) continue;
    const double arrival_step = *first[k].arrival - *first[k - 1].arrival;
    if (arrival_step > 0.0) keep(arrival_steps_, arrival_step);
  }
}

void ScanPace::add(double stamp, double step, const std::optional<double>& arrival,
                   std::optional<double> arrival_step) {
  if (step > 0.0) keep(steps_, step);
  if (arrival_step && *arrival_step > 0.0) keep(arrival_steps_, *arrival_step);
  if (arrival) keep(latencies_, *arrival - stamp);
}

double ScanPace::step() const {
  return steps_.empty() ? (arrival_steps_.empty() ? kUsualStep : median(arrival_steps_)) : median(steps_);
}

bool ScanPace::comparable() const {
  if (steps_.empty() || arrival_steps_.empty()) return false;
  return std::abs(median(arrival_steps_) / median(steps_) - 1.0) < kSamePace;
}

bool ScanPace::too_early(double stamp, const std::optional<double>& arrival) const {
  if (!arrival || latencies_.empty() || !comparable()) return false;
  const double shortest = *std::min_element(latencies_.begin(), latencies_.end());
  return *arrival - stamp < shortest - std::max(kLatencyJitter, 0.5 * step());
}

double ScanPace::due(std::optional<double> arrival_step) const {
  const double usual = step();
  if (!arrival_step || !comparable() || *arrival_step < kBurst * usual) return usual;
  const double whole = std::round(*arrival_step / usual) * usual;
  return std::abs(*arrival_step - whole) < kNearWhole * usual ? whole : *arrival_step;
}

}  // namespace tilth
