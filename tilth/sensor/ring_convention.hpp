// Which beam a point comes from: the ring field brought to 0 = lowest, else worked out from elevation or from the order
// of storage. Where the clouds are not in the sensor's own frame, it is looked for in the points. Decided over the
// first scans and then kept.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <tilth/sensor/point_fields.hpp>

namespace tilth {

class RingConvention {
 public:
  /// `roles` of the first of `scans`; at least one scan.
  RingConvention(std::span<const MeasuredPoints> scans, const PointFieldRoles& roles);

  /// One ring a point, 0 = lowest; none where this recording has no rings or this scan breaks the convention. O(n log
  /// rings).
  std::vector<std::uint16_t> rings_of(const MeasuredPoints& scan) const;

  /// How the sensor is mounted in the frame of the clouds, where that is not its own.
  const std::optional<Eigen::Isometry3d>& T_cloud_sensor() const { return T_cloud_sensor_; }

  const std::string& decision() const { return decision_; }

 private:
  enum class From { nothing, field, beams, rows };

  bool decide_from_field(std::span<const MeasuredPoints> scans, const std::string& name);
  void decide_from_points(std::span<const MeasuredPoints> scans);
  std::vector<std::uint16_t> rings_by_field(const MeasuredPoints& scan) const;
  std::vector<std::uint16_t> rings_by_row(const MeasuredPoints& scan) const;

  From from_ = From::nothing;
  std::optional<Eigen::Isometry3d> T_cloud_sensor_;
  std::vector<std::uint16_t> ring_of_value_;  ///< by value of the ring field; empty: the value is the ring
  std::vector<double> beams_;                 ///< [rad] ascending
  std::string decision_;
};

}  // namespace tilth
