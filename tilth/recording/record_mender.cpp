#include <cmath>
#include <cstdio>

#include <tilth/core/error.hpp>
#include <tilth/recording/byte_order.hpp>
#include <tilth/recording/flat_cloud.hpp>
#include <tilth/recording/map_coordinates.hpp>
#include <tilth/recording/record_edit.hpp>
#include <tilth/recording/record_mender.hpp>

namespace tilth {
namespace {

constexpr double kFollows = 0.2;       ///< of a scan, in what ranges are usual
constexpr std::size_t kSample = 1024;  ///< points of a scan that tell its unit

std::string text(const char* format, auto... values) {
  char line[320];
  std::snprintf(line, sizeof line, format, values...);
  return line;
}

std::optional<PointFieldRoles> roles_if_readable(const PointRecords& records) {
  try {
    return roles_of(records);
  } catch (const Error&) {
    return std::nullopt;
  }
}

std::vector<std::vector<double>> columns(std::span<const PointRecords> scans, const auto& role) {
  std::vector<std::vector<double>> all;
  for (const PointRecords& scan : scans) {
    if (const std::optional<PointField> field = role(roles_of(scan))) all.push_back(column(scan, *field));
  }
  return all;
}

}  // namespace

RecordMender::RecordMender(std::span<const StampedRecords> first, const RecordingTraits& traits) {
  std::vector<PointRecords> scans;
  std::size_t other = 0;
  for (const StampedRecords& stamped : first) {
    const std::optional<PointFieldRoles> roles = roles_if_readable(stamped.records);
    if (!roles || measured_sample(stamped.records, kSample).empty()) continue;
    scans.push_back(stamped.records);
    const std::endian order = byte_order_of(stamped.records, *roles);
    other += order != scans.back().byte_order ? 1 : 0;
    scans.back().byte_order = order;
  }
  if (scans.empty()) return;
  if (other > 0) {
    const char* order = scans.front().byte_order == std::endian::big ? "big" : "little";
    decisions_.push_back(text("byte order: the numbers are %s-endian, which is not what the clouds state", order));
  }
  rings_.emplace(columns(scans, [](const PointFieldRoles& roles) { return roles.ring; }));
  const bool read = traits.times == CloudTimes::automatic && !traits.deskewed;
  times_.emplace(columns(scans, [=](const PointFieldRoles& roles) { return read ? roles.time : std::nullopt; }));
  refuse_flat_clouds(scans);
  if (const std::optional<MapCoordinates> map = map_coordinates(scans, *rings_)) {
    offset_ = map->sensor;
    decisions_.push_back(map->sentence);
  }
  decide_unit(scans, traits.unit);
}

void RecordMender::decide_unit(std::span<const PointRecords> first, LengthUnit asked) {
  if (asked != LengthUnit::automatic) {
    unit_ = asked;
    decisions_.push_back("unit: coordinates are in " + to_text(unit_) + ", as asked for");
    return;
  }
  std::vector<Eigen::Vector3d> points;
  for (const PointRecords& scan : first) {
    for (const Eigen::Vector3d& p : measured_sample(scan, kSample)) points.push_back(p - offset_);
  }
  const std::optional<ScanExtent> extent = extent_of(points);
  if (!extent) return;
  unit_ = unit_of_length(*extent);
  range_ = extent->range + std::log10(metres_of(unit_));
  if (unit_ == LengthUnit::metres) return;
  decisions_.push_back(
      "unit: coordinates are in " + to_text(unit_) +
      text(", as ranges of about %.0f are no metres; --unit says another", std::pow(10, extent->range)));
}

void RecordMender::mend(PointRecords& records) {
  const std::size_t scan = scans_++;
  std::optional<PointFieldRoles> roles = roles_if_readable(records);
  if (!roles || !rings_) return;
  if (const std::endian order = byte_order_of(records, *roles); order != records.byte_order) {
    records.byte_order = order;
    ++other_order_;
  }
  leave_out_bad_values(records);
  const LengthUnit before = unit_;
  follow_unit(records);
  if (unit_ != before)
    changes_.push_back(text("unit: from scan %zu on coordinates are in ", scan) + to_text(unit_) + ", before in " +
                       to_text(before));
  if (unit_ != LengthUnit::metres || !offset_.isZero(0.0)) to_metres(records, *roles);
}

void RecordMender::leave_out_bad_values(PointRecords& records) {
  const auto take = [&](const std::optional<PointField>& field, const auto& values, Count& count) {
    if (!field) return;
    const ValueCheck check = values.check(column(records, *field));
    if (check.unusable) {
      ++count.unread;
      remove_field(records, field->name);
    } else if (check.bad > 0) {
      count.values += check.bad;
      ++count.scans;
      records = kept_records(records, check.keep);
    }
  };
  const PointFieldRoles roles = roles_of(records);
  take(roles.ring, *rings_, bad_rings_);
  take(roles.time, *times_, bad_times_);
}

void RecordMender::follow_unit(const PointRecords& records) {
  if (!range_) return;
  std::vector<Eigen::Vector3d> points = measured_sample(records, kSample);
  for (Eigen::Vector3d& p : points) p -= offset_;
  const std::optional<ScanExtent> extent = extent_of(points);
  if (!extent) return;
  unit_ = unit_after(unit_, *range_, *extent);
  *range_ += kFollows * (extent->range + std::log10(metres_of(unit_)) - *range_);
}

void RecordMender::to_metres(PointRecords& records, const PointFieldRoles& roles) const {
  std::vector<Eigen::Vector3d> points = coordinates_of(records, roles);
  for (Eigen::Vector3d& p : points) {
    if (!p.isZero(0.0)) p = metres_of(unit_) * (p - offset_);
  }
  records = with_coordinates(records, roles, points);
}

std::vector<std::string> RecordMender::notices() const {
  std::vector<std::string> all = changes_;
  const auto tell = [&](const std::string& field, const std::string& what, const Count& count) {
    if (count.values > 0)
      all.push_back(field + text(": %zu points of %zu scans are left out: ", count.values, count.scans) + what);
    if (count.unread > 0)
      all.push_back(field +
                    text(": not read in %zu scans, in which it has mostly values that can be none", count.unread));
  };
  tell("ring", "their values name no beam (such as 65535, NaN or below 0)", bad_rings_);
  tell("time", "their times lie far outside the scan, or are no numbers", bad_times_);
  if (other_order_ > 0)
    all.push_back(text("byte order: %zu clouds state another than their numbers are in", other_order_));
  return all;
}

}  // namespace tilth
