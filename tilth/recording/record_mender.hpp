// Records as recorders leave them -> records as a ScanDecoder reads them: numbers in the byte order they are in,
// coordinates in metres about the sensor, without the points whose ring or time can be none. Decided over the first
// records, followed as units change, and said. O(n) a scan.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tilth/recording/field_values.hpp>
#include <tilth/sensor/length_unit.hpp>
#include <tilth/sensor/scan_decoder.hpp>

namespace tilth {

class RecordMender {
 public:
  /// Throws Error where the clouds are flat, coordinates have too few digits for how far they are from 0, their unit
  /// cannot be told, or they are those of a map in which the sensor moves.
  RecordMender(std::span<const StampedRecords> first, const RecordingTraits& traits);

  /// What cannot be read is left as it is, for the decoder to refuse.
  void mend(PointRecords& records);

  const std::vector<std::string>& decisions() const { return decisions_; }

  /// What was mended so far, one sentence each.
  std::vector<std::string> notices() const;

 private:
  /// Values left out of how many scans, and scans in which the field was not read.
  struct Count {
    std::size_t values = 0, scans = 0, unread = 0;
  };

  void decide_unit(std::span<const PointRecords> first, LengthUnit asked);
  void follow_unit(const PointRecords& records);
  void leave_out_bad_values(PointRecords& records);
  void to_metres(PointRecords& records, const PointFieldRoles& roles) const;

  std::optional<RingValues> rings_;
  std::optional<TimeValues> times_;
  Eigen::Vector3d offset_ = Eigen::Vector3d::Zero();  ///< in the recording's unit
  LengthUnit unit_ = LengthUnit::metres;
  std::optional<double> range_;  ///< [log m] of the last scan; none: the unit is not followed
  Count bad_rings_, bad_times_;
  std::size_t scans_ = 0, other_order_ = 0;
  std::vector<std::string> decisions_, changes_;
};

}  // namespace tilth
