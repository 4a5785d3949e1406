// How much of a scan agrees with the map it was registered to, and how much usually does.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <tilth/core/median.hpp>
#include <tilth/registration/align_result.hpp>

namespace tilth {

/// The median of the last values.
class RunningMedian {
 public:
  explicit RunningMedian(std::size_t most) : most_(most) {}

  void add(double value) {
    if (values_.size() < most_) {
      values_.push_back(value);
    } else {
      values_[next_] = value;
    }
    next_ = (next_ + 1) % most_;
  }

  std::size_t size() const { return values_.size(); }

  /// 0 before any.
  double value() const { return values_.empty() ? 0.0 : median(values_); }

 private:
  std::size_t most_, next_ = 0;
  std::vector<double> values_;
};

/// [-] share of what was looked up that agrees with the map, weighted by the robust kernel.
inline double fit_of(const AlignResult& alignment) {
  return alignment.candidates == 0 ? 0.0 : alignment.weight / double(alignment.candidates);
}

/// Shares of the usual fit below which a scan does not lie where it was put.
struct FitBounds {
  double poor;  ///< of one that follows a scan that fitted
  double sure;  ///< of one after a doubt, or after a time of which nothing is known: other rooms of a building fit, too
};

/// Of the last scans that were believed.
class UsualFit {
 public:
  explicit UsualFit(const FitBounds& bounds) : bounds_(bounds) {}

  /// A scan `interval` [s] after the one before.
  void add(const AlignResult& alignment, double interval) {
    fits_.add(fit_of(alignment));
    intervals_.add(interval);
    in_doubt_ = false;
  }

  /// A scan that was not believed.
  void doubt() { in_doubt_ = true; }

  void forget() { *this = UsualFit(bounds_); }

  /// Of the usual fit; 1 before any.
  double ratio(const AlignResult& alignment) const {
    const double usual = fits_.value();
    return usual > 0 ? fit_of(alignment) / usual : 1.0;
  }

  /// Whether next to nothing of the scan was found in the map.
  static bool is_unmatched(const AlignResult& alignment) {
    constexpr std::size_t kFewMatches = 20;
    constexpr double kLeastFit = 0.12;
    return alignment.matches < kFewMatches || fit_of(alignment) < kLeastFit;
  }

  /// Whether the scan, which comes `interval` [s] after the last one that was believed, lies somewhere else than where
  /// it was put.
  bool is_poor(const AlignResult& alignment, double interval) const {
    constexpr double kKnown = 0.5, kUnknown = 1.5;  // [s] more than usual
    const double late = (interval - intervals_.value() - kKnown) / (kUnknown - kKnown);
    const double least = std::lerp(bounds_.poor, bounds_.sure, in_doubt_ ? 1.0 : std::clamp(late, 0.0, 1.0));
    return is_unmatched(alignment) || ratio(alignment) < least;
  }

  /// Whether a scan so long after the last one that was believed should be tried elsewhere, too.
  bool is_doubtful(const AlignResult& alignment, double interval) const {
    constexpr double kGap = 1.8;  // times the usual interval
    constexpr double kRatio = 0.7, kRatioAfterGap = 0.95;
    return ratio(alignment) < (interval > kGap * intervals_.value() ? kRatioAfterGap : kRatio);
  }

 private:
  static constexpr std::size_t kScans = 21;
  FitBounds bounds_;
  RunningMedian fits_{kScans}, intervals_{kScans};
  bool in_doubt_ = false;
};

}  // namespace tilth
