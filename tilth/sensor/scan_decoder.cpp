#include <algorithm>
#include <array>
#include <cstdio>
#include <numbers>
#include <numeric>
#include <utility>

#include <tilth/core/error.hpp>
#include <tilth/sensor/azimuth_times.hpp>
#include <tilth/sensor/firing_cycle.hpp>
#include <tilth/sensor/firing_order.hpp>
#include <tilth/sensor/scan_decoder.hpp>
#include <tilth/sensor/sensor_mount.hpp>
#include <tilth/sensor/spin.hpp>

namespace tilth {
namespace {

std::string counted(const MeasuredPoints& scan) {
  const std::size_t all = scan.points.size() + scan.not_finite + scan.no_return;
  return "points: " + std::to_string(scan.points.size()) + " of " + std::to_string(all) + " in the first scan (" +
         std::to_string(scan.no_return) + " without return, " + std::to_string(scan.not_finite) + " not finite)";
}

std::string intensity_sentence(const std::optional<PointField>& field) {
  return field ? "intensity: field '" + field->name + "' (" + name_of(field->type) + ")" : "intensity: no field";
}

StampOrigin origin_of(const RecordingTraits& traits) {
  if (traits.nominal_stamps) return StampOrigin::order;
  return traits.end_stamps ? StampOrigin::recorder : StampOrigin::own;
}

PointCloud without(const PointCloud& cloud, const std::vector<std::uint32_t>& left_out) {
  std::vector<std::uint32_t> all(cloud.size()), kept;
  std::iota(all.begin(), all.end(), 0u);
  std::set_difference(all.begin(), all.end(), left_out.begin(), left_out.end(), std::back_inserter(kept));
  return select(cloud, kept);
}

}  // namespace

std::span<const std::string_view> names_of(CloudTimes) {
  static constexpr std::array<std::string_view, 3> kNames{"auto", "none", "derived"};
  return kNames;
}

ScanDecoder::ScanDecoder(std::span<const StampedRecords> first_scans, const RecordingTraits& traits)
    : end_stamps_(traits.end_stamps) {
  std::vector<MeasuredPoints> scans;
  std::vector<CloudStamp> stamps;
  std::optional<PointFieldRoles> roles;
  std::optional<Error> first_error;
  for (const StampedRecords& scan : first_scans) {
    try {
      const PointFieldRoles own = roles_of(scan.records);
      scans.push_back(measured_points(scan.records, own));
      stamps.push_back(scan.stamp);
      if (!roles) roles = own;
    } catch (const Error& error) {
      if (!first_error) first_error = error;
    }
  }
  if (!roles) throw first_error.value_or(Error("recording", "has no scan"));
  decisions_ = {counted(scans.front()), intensity_sentence(roles->intensity)};
  rings_.emplace(scans, *roles);
  decisions_.push_back(rings_->decision());
  decide_times(scans, stamps, roles->time, traits);
}

void ScanDecoder::decide_times(std::span<const MeasuredPoints> scans, std::span<const CloudStamp> stamps,
                               const std::optional<PointField>& field, const RecordingTraits& traits) {
  if (traits.times == CloudTimes::none) {
    decisions_.emplace_back("time: none, as asked for (times=none): every point was taken at the stamp of its scan");
    return;
  }
  if (traits.times == CloudTimes::derived) {
    decisions_.emplace_back("time: no field is read, as asked for (times=derived)");
    decide_spin(scans, stamps, traits);
    if (!spin_period_) throw Error("option times=derived", "cannot be followed; " + decisions_.back());
    return;
  }
  if (traits.deskewed) {
    decisions_.emplace_back("time: none, the scans of this format are deskewed already");
    return;
  }
  if (field) {
    std::vector<std::vector<double>> values;
    for (const MeasuredPoints& scan : scans) values.push_back(scan.time_values);
    if (std::any_of(values.begin(), values.end(), [](const auto& v) { return v.empty(); })) values.clear();
    if (values.empty()) return decisions_.push_back("time: field '" + field->name + "' is not in every scan: not used");
    const TimeDecision decision = decide_time(values, stamps, *field, origin_of(traits));
    times_ = decision.convention;
    decisions_.push_back(decision.sentence);
    if (times_) {
      char text[64];
      std::snprintf(text, sizeof text, "spin: a scan spans %.4f s of point times", times_->span);
      decisions_.emplace_back(text);
    }
    if (times_ || decision.snapshot) return;
  }
  decide_spin(scans, stamps, traits);
  if (spin_period_) {
    decisions_.emplace_back(
        "if every scan was taken at once, as simulators do, derived times bend it: --times none says so");
  }
}

void ScanDecoder::decide_spin(std::span<const MeasuredPoints> scans, std::span<const CloudStamp> stamps,
                              const RecordingTraits& traits) {
  std::vector<HeadRotation> rotations;
  std::vector<double> rotation_stamps;
  for (std::size_t k = 0; k < scans.size(); ++k) {
    std::optional<HeadRotation> rotation = rotation_of(scans[k].points, rings_->rings_of(scans[k]));
    if (!rotation) continue;
    rotations.push_back(std::move(*rotation));
    rotation_stamps.push_back(stamps[k].stamp);
  }
  if (rotations.empty() || 2 * rotations.size() < scans.size()) {
    decisions_.emplace_back("time: no field and the points are not in the order of firing: no point times");
    return;
  }
  if (rotations.front().ray_grid && traits.times != CloudTimes::derived) {
    decisions_.emplace_back(
        "time: no field, and the points lie on a ray caster's exact grid: scans are snapshots, no point times");
    return;
  }
  const SpinDecision spin =
      measure_spin(rotations, rotation_stamps, traits.nominal_stamps,
                   {column_step(in_sensor(scans.front().points), rings_->rings_of(scans.front())), traits.spin_period});
  spin_period_ = spin.period;
  cut_ = spin.cut;
  clockwise_ = rotations.front().clockwise;
  decisions_.push_back(spin.sentence);
}

std::vector<Eigen::Vector3d> ScanDecoder::in_sensor(std::span<const Eigen::Vector3d> points) const {
  const std::optional<Eigen::Isometry3d>& T_cloud_sensor = rings_->T_cloud_sensor();
  return T_cloud_sensor ? in_sensor_frame(points, *T_cloud_sensor) : std::vector(points.begin(), points.end());
}

std::optional<HeadRotation> ScanDecoder::rotation_of(std::span<const Eigen::Vector3d> points,
                                                     std::span<const std::uint16_t> rings) const {
  return rings_->T_cloud_sensor() ? find_head_rotation(in_sensor(points), rings) : find_head_rotation(points, rings);
}

Scan ScanDecoder::decode(const StampedRecords& stamped) const {
  MeasuredPoints measured = measured_points(stamped.records, roles_of(stamped.records));
  Scan scan;
  scan.stamp = stamped.stamp.stamp;
  scan.T_cloud_sensor = rings_->T_cloud_sensor();
  scan.cloud.rings = rings_->rings_of(measured);
  scan.cloud.intensities = std::move(measured.intensities);
  set_times(measured, stamped.stamp.stamp, scan);
  return scan;
}

std::optional<double> ScanDecoder::turn_duration(const StampedRecords& stamped) const {
  constexpr double kLeast = 1.0;  // [rad]
  const Scan scan = decode(stamped);
  if (!scan.cloud.has_times()) return std::nullopt;
  const std::optional<HeadRotation> rotation = rotation_of(scan.cloud.points, scan.cloud.rings);
  if (!rotation || rotation->covered() < kLeast) return std::nullopt;
  const auto [first, last] = std::minmax_element(scan.cloud.times.begin(), scan.cloud.times.end());
  return double(*last - *first) * 2 * std::numbers::pi / rotation->covered();
}

/// Times by the order of firing; where the points are too few or in another order, by their azimuth since a fixed cut.
void ScanDecoder::derive_times(std::span<const Eigen::Vector3d> points, Scan& scan) const {
  std::vector<double> times;
  if (const std::optional<HeadRotation> rotation = rotation_of(points, scan.cloud.rings)) {
    const double rate = *spin_period_ / (2 * std::numbers::pi);
    if (cut_ && !end_stamps_) scan.stamp += delay_of_first(*rotation, *cut_, *spin_period_);
    for (const double angle : rotation->progress) times.push_back(angle * rate);
    if (end_stamps_) scan.stamp -= rotation->covered() * rate;
  } else if (cut_) {
    times = times_by_azimuth(in_sensor(points), {*cut_, *spin_period_, clockwise_});
    const double first = *std::min_element(times.begin(), times.end());
    for (double& time : times) time -= first;
    scan.stamp += end_stamps_ ? first - *spin_period_ : first;
  }
  scan.cloud.times.assign(times.begin(), times.end());
}

void ScanDecoder::set_times(MeasuredPoints& measured, double stamp, Scan& scan) const {
  if (spin_period_) derive_times(measured.points, scan);
  scan.cloud.points = std::move(measured.points);
  if (!times_ || measured.time_values.empty()) return;
  if (std::optional<PointTimes> times = point_times(*times_, measured.time_values, stamp)) {
    scan.stamp = times->stamp;
    scan.cloud.times = std::move(times->times);
    if (!times->outliers.empty()) scan.cloud = without(scan.cloud, times->outliers);
  }
}

}  // namespace tilth
