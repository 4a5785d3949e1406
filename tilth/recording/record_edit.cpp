#include <algorithm>
#include <array>
#include <cstring>

#include <tilth/core/evenly_chosen.hpp>
#include <tilth/core/median.hpp>
#include <tilth/recording/record_edit.hpp>

namespace tilth {
namespace {

constexpr std::size_t kCoordinates = 3 * sizeof(double);  // [bytes]

/// The same fields without a record.
PointRecords empty_like(const PointRecords& records) {
  return {records.fields, records.stride, 0, records.byte_order, {}};
}

void append_record(const PointRecords& from, std::size_t i, PointRecords& to) {
  const auto begin = from.bytes.begin() + std::ptrdiff_t(i * from.stride);
  to.bytes.insert(to.bytes.end(), begin, begin + std::ptrdiff_t(from.stride));
  ++to.count;
}

void append_number(double value, std::endian order, std::vector<std::byte>& bytes) {
  auto raw = std::bit_cast<std::array<std::byte, sizeof(double)>>(value);
  if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
  bytes.insert(bytes.end(), raw.begin(), raw.end());
}

/// Takes out points that lie farther from the middle of the others than any sensor sees, whatever the unit: numbers
/// that some drivers write where nothing came back.
void erase_strays(std::vector<Eigen::Vector3d>& points) {
  constexpr double kTimesAsFar = 300;  // as half of the points lie
  if (points.empty()) return;
  Eigen::Vector3d middle;
  std::vector<double> values(points.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::transform(points.begin(), points.end(), values.begin(), [&](const auto& p) { return p[axis]; });
    middle[axis] = median(values);
  }
  std::transform(points.begin(), points.end(), values.begin(), [&](const auto& p) { return (p - middle).norm(); });
  const double most = kTimesAsFar * median(values);
  std::erase_if(points, [&](const Eigen::Vector3d& p) { return (p - middle).norm() > most; });
}

}  // namespace

PointRecords kept_records(const PointRecords& records, std::span<const std::uint8_t> keep) {
  PointRecords kept = empty_like(records);
  for (std::size_t i = 0; i < records.count; ++i) {
    if (keep[i] != 0) append_record(records, i, kept);
  }
  return kept;
}

PointRecords sampled_records(const PointRecords& records, std::size_t count) {
  PointRecords sample = empty_like(records);
  const std::size_t step = stride_of(records.count, count);
  for (std::size_t i = 0; i < records.count && sample.count < count; i += step) append_record(records, i, sample);
  return sample;
}

std::vector<Eigen::Vector3d> coordinates_of(const PointRecords& records, const PointFieldRoles& roles) {
  const std::vector<double> x = column(records, roles.x), y = column(records, roles.y), z = column(records, roles.z);
  std::vector<Eigen::Vector3d> points(records.count);
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = {x[i], y[i], z[i]};
  return points;
}

std::vector<Eigen::Vector3d> measured_sample(const PointRecords& records, std::size_t count) {
  const PointRecords sample = sampled_records(records, count);
  std::vector<Eigen::Vector3d> points = coordinates_of(sample, roles_of(sample));
  std::erase_if(points, [](const Eigen::Vector3d& p) { return !p.allFinite() || p.isZero(0.0); });
  erase_strays(points);
  return points;
}

PointRecords with_coordinates(const PointRecords& records, const PointFieldRoles& roles,
                              std::span<const Eigen::Vector3d> points) {
  PointRecords moved{{{"x", FieldType::f64, 0}, {"y", FieldType::f64, 8}, {"z", FieldType::f64, 16}},
                     records.stride + kCoordinates,
                     records.count,
                     records.byte_order,
                     {}};
  for (PointField field : records.fields) {
    if (field.name == roles.x.name || field.name == roles.y.name || field.name == roles.z.name) continue;
    field.offset += kCoordinates;
    moved.fields.push_back(std::move(field));
  }
  moved.bytes.reserve(moved.count * moved.stride);
  for (std::size_t i = 0; i < records.count; ++i) {
    for (const double value : {points[i].x(), points[i].y(), points[i].z()})
      append_number(value, records.byte_order, moved.bytes);
    const auto begin = records.bytes.begin() + std::ptrdiff_t(i * records.stride);
    moved.bytes.insert(moved.bytes.end(), begin, begin + std::ptrdiff_t(records.stride));
  }
  return moved;
}

void remove_field(PointRecords& records, std::string_view name) {
  std::erase_if(records.fields, [&](const PointField& field) { return field.name == name; });
}

}  // namespace tilth
