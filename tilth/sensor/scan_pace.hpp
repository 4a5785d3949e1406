// How fast scans usually follow one another, on the clock of their stamps and on that of the recorder, and how long
// after its stamp the recorder has a scan: the context in which a single stamp is judged. O(1) a scan.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace tilth {

/// A scan as it was recorded.
struct StampReading {
  std::size_t scan = 0;           ///< in the recording
  double stamp = 0.0;             ///< [s] of the first point, as recorded: it may be anything
  std::optional<double> arrival;  ///< [s] when the recorder had it, on its own clock
  std::size_t content = 0;        ///< the same number where the points are the same
};

/// The same message, stored twice: same stamp, same points, and the recorder did not have them a scan apart.
bool are_twins(const StampReading& a, const StampReading& b);

class ScanPace {
 public:
  /// From the first readings, among which single ones may be wrong.
  explicit ScanPace(std::span<const StampReading> first);

  /// A scan that got `stamp` after a step of `step` [s]; `arrival_step` [s] since the recorder had the one before.
  void add(double stamp, double step, const std::optional<double>& arrival, std::optional<double> arrival_step);

  double step() const;  ///< [s] between stamps, the median; 0.1 where nothing tells it

  /// Both clocks run at the same pace: the recorder's steps say something about those of the stamps.
  bool comparable() const;

  /// `arrival` less `stamp` is shorter than it ever was of late: the scan would have been recorded before it was taken.
  bool too_early(double stamp, const std::optional<double>& arrival) const;

  /// [s] the recorder's step as that of the sensor: a whole number of usual steps where it is near one.
  double due(std::optional<double> arrival_step) const;

 private:
  std::vector<double> steps_, arrival_steps_, latencies_;  // [s] the last few of each
};

}  // namespace tilth
