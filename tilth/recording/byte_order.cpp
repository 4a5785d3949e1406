#include <algorithm>
#include <cmath>

#include <tilth/recording/byte_order.hpp>
#include <tilth/recording/record_edit.hpp>

namespace tilth {
namespace {

constexpr std::size_t kSample = 256;
constexpr double kSmallest = 1e-5, kLargest = 1e8;  // of a coordinate that is not zero, in whatever unit
constexpr double kFew = 0.5, kNearlyAll = 0.9;

bool is_measured(double value) {
  return value == 0.0 || (std::abs(value) > kSmallest && std::abs(value) < kLargest);
}

/// Of the points that are not (0, 0, 0), those that may be measured.
double plausible_ratio(const PointRecords& sample, const PointFieldRoles& roles) {
  std::size_t all = 0, plausible = 0;
  for (const Eigen::Vector3d& p : coordinates_of(sample, roles)) {
    if (p.isZero(0.0) || p.hasNaN()) continue;
    ++all;
    plausible += is_measured(p.x()) && is_measured(p.y()) && is_measured(p.z()) ? 1 : 0;
  }
  return all == 0 ? 1.0 : double(plausible) / double(all);
}

}  // namespace

std::endian byte_order_of(const PointRecords& records, const PointFieldRoles& roles) {
  PointRecords sample = sampled_records(records, kSample);
  if (plausible_ratio(sample, roles) > kFew) return records.byte_order;
  const std::endian other = records.byte_order == std::endian::little ? std::endian::big : std::endian::little;
  sample.byte_order = other;
  return plausible_ratio(sample, roles) > kNearlyAll ? other : records.byte_order;
}

}  // namespace tilth
