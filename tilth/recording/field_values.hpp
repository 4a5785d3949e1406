// Which values of the ring and time fields can be what they should: told by the first scans, so that single bad ones
// (65535, NaN, negative, huge) take out their points and no more. O(n log n) where values are bad, else O(n).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace tilth {

/// What to do with the points of one scan.
struct ValueCheck {
  std::vector<std::uint8_t> keep;  ///< one a point; empty: all are good
  std::size_t bad = 0;
  bool unusable = false;  ///< most are bad: the field is not to be read in this scan
};

class RingValues {
 public:
  /// Nothing is checked where most of the first values are no rings: such a field is left to whoever reads it.
  explicit RingValues(std::span<const std::vector<double>> first_scans);

  ValueCheck check(std::span<const double> values) const;

 private:
  double limit_ = 0.0;  ///< rings are below; 0: nothing is checked
};

class TimeValues {
 public:
  /// Nothing is checked where the first scans span no time.
  explicit TimeValues(std::span<const std::vector<double>> first_scans);

  ValueCheck check(std::span<const double> values) const;

 private:
  double span_ = 0.0;  ///< of a scan, in the field's unit
};

}  // namespace tilth
