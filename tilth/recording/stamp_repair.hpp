// Stamps in their context: a stamp that repeats, falls back or runs ahead is judged by the scans before and after it
// and by the recorder's times, and replaced by the one that fits; a clock that was set is followed. Stamps that can be
// are given out as they are, to the last bit. docs/formats/time_and_ring.md. O(1) a scan.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tilth/recording/stamp_findings.hpp>
#include <tilth/sensor/scan_pace.hpp>

namespace tilth {

struct StampVerdict {
  std::size_t take = 0;  ///< the reading of the window that comes next
  double stamp = 0.0;    ///< [s] its stamp, later than that of the scan before
  std::string left_out;  ///< why that reading is passed over; empty: it is not
};

class StampRepair {
 public:
  static constexpr std::size_t kAhead = 4;  ///< readings that are looked at beyond the one to judge

  /// From the first readings of the recording.
  explicit StampRepair(std::span<const StampReading> first) : pace_(first) {}

  /// `window` holds the readings not yet taken: at least one, and kAhead more where there are so many.
  StampVerdict next(std::span<const StampReading> window);

  const StampFindings& findings() const { return findings_; }

 private:
  struct Given {
    StampReading reading;
    double stamp = 0.0;  // [s]
  };
  const StampReading* twin_of(const StampReading& reading) const;
  std::optional<std::size_t> overtaken(std::span<const StampReading> window) const;
  bool in_line(std::span<const StampReading> window) const;
  std::optional<std::size_t> back_in_line(std::span<const StampReading> window) const;
  double step_to(const StampReading& reading) const;
  std::optional<double> arrival_step(const StampReading& reading) const;
  StampVerdict first_of(std::span<const StampReading> window);
  StampVerdict mend(std::span<const StampReading> window);
  StampVerdict set_clock(std::span<const StampReading> window);
  StampVerdict give(const StampReading& reading, double stamp, std::size_t take);

  ScanPace pace_;
  StampFindings findings_;
  std::optional<Given> last_;
  double offset_ = 0.0;            // [s] from recorded stamps to those given out
  std::deque<StampReading> seen_;  // the last ones
};

/// The stamps [s] that `readings` get, in their order; nothing where one is left out.
std::vector<std::optional<double>> repaired_stamps(std::span<const StampReading> readings);

}  // namespace tilth
