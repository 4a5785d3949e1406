// Point records with the stamp of their header -> a scan. What the fields mean is decided once, over the first scans of
// a recording, and said in sentences (docs/formats/time_and_ring.md). O(n log rings) a scan.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <tilth/core/options.hpp>
#include <tilth/core/scan.hpp>
#include <tilth/sensor/firing_order.hpp>
#include <tilth/sensor/length_unit.hpp>
#include <tilth/sensor/ring_convention.hpp>
#include <tilth/sensor/time_convention.hpp>

namespace tilth {

struct StampedRecords {
  CloudStamp stamp;
  PointRecords records;
};

/// Where the times of points come from. automatic: their field, else the order of firing; derived: that order whatever
/// a field says; none: nowhere, a scan was taken at its stamp.
enum class CloudTimes { automatic, none, derived };
std::span<const std::string_view> names_of(CloudTimes);

struct CloudOptions {
  CloudTimes times = CloudTimes::automatic;
  LengthUnit unit = LengthUnit::automatic;
  std::optional<double> spin_period = {};  ///< [s] about, where scans with other fields tell it
};

template <class V>
void visit(CloudOptions& o, V&& v) {
  v("times", o.times,
    "[-] of the points of clouds; auto: their field, else the order of firing; none: a scan was taken at once, as in a "
    "simulator; derived: the order of firing, whatever a field says");
  v("unit", o.unit, "[-] of the coordinates of clouds; auto: metres, or what their ranges tell");
}

/// What is known of a recording beside its records.
struct RecordingTraits {
  bool nominal_stamps = false;  ///< nobody recorded them
  bool deskewed = false;        ///< the points of a scan already share one instant
  bool end_stamps = false;      ///< stamps follow the last point: they are the recorder's
  CloudTimes times = CloudTimes::automatic;
  LengthUnit unit = LengthUnit::automatic;
  std::optional<double> spin_period = {};  ///< [s] about, where scans with other fields tell it
};

class ScanDecoder {
 public:
  /// Decides from the first scans; those that cannot be read are left out. Throws the Error of the first where none
  /// can, and where times are to be derived that the points do not tell.
  ScanDecoder(std::span<const StampedRecords> first_scans, const RecordingTraits& traits);

  /// Throws Error where x, y or z is missing or no point is valid.
  Scan decode(const StampedRecords& scan) const;

  const std::vector<std::string>& decisions() const { return decisions_; }
  bool reads_times() const { return times_.has_value(); }  ///< of a field
  /// [s] that the head takes for a turn, by the times of a scan and the angle that it spans; where both are known.
  std::optional<double> turn_duration(const StampedRecords& stamped) const;

 private:
  void decide_times(std::span<const MeasuredPoints> scans, std::span<const CloudStamp> stamps,
                    const std::optional<PointField>& field, const RecordingTraits& traits);
  void decide_spin(std::span<const MeasuredPoints> scans, std::span<const CloudStamp> stamps,
                   const RecordingTraits& traits);
  /// As the sensor sees them, where the cloud is in another frame.
  std::vector<Eigen::Vector3d> in_sensor(std::span<const Eigen::Vector3d> points) const;
  std::optional<HeadRotation> rotation_of(std::span<const Eigen::Vector3d> points,
                                          std::span<const std::uint16_t> rings) const;
  void derive_times(std::span<const Eigen::Vector3d> points, Scan& scan) const;
  void set_times(MeasuredPoints& measured, double stamp, Scan& scan) const;

  std::optional<RingConvention> rings_;
  std::optional<TimeConvention> times_;
  std::optional<double> spin_period_;  ///< [s] where times are derived from the order of firing
  bool end_stamps_ = false, clockwise_ = true;
  std::optional<double> cut_;  ///< [rad] azimuth where the stamps stand, where all scans begin there
  std::vector<std::string> decisions_;
};

}  // namespace tilth
