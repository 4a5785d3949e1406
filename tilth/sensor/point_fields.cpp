#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <string_view>

#include <tilth/core/error.hpp>
#include <tilth/sensor/point_fields.hpp>

namespace tilth {
namespace {

std::string plain_name(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  constexpr std::string_view prefix = "scalar_";
  return name.starts_with(prefix) ? name.substr(prefix.size()) : name;
}

/// The field with the first of `names` that any field has.
std::optional<PointField> first_of(const PointRecords& records, std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names) {
    for (const PointField& field : records.fields) {
      if (plain_name(field.name) == name) return field;
    }
  }
  return std::nullopt;
}

PointField coordinate(const PointRecords& records, std::string_view name) {
  if (const auto field = first_of(records, {name})) return *field;
  std::string present;
  for (const PointField& field : records.fields) present += (present.empty() ? "" : ", ") + field.name;
  throw Error("field " + std::string(name), "is missing; the fields are: " + (present.empty() ? "none" : present));
}

std::vector<std::uint32_t> with_return(const std::array<std::vector<double>, 3>& xyz, MeasuredPoints& measured) {
  std::vector<std::uint32_t> kept;
  kept.reserve(xyz[0].size());
  for (std::size_t i = 0; i < xyz[0].size(); ++i) {
    const double x = xyz[0][i], y = xyz[1][i], z = xyz[2][i];
    if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z))
      ++measured.not_finite;
    else if (x == 0.0 && y == 0.0 && z == 0.0)
      ++measured.no_return;
    else
      kept.push_back(std::uint32_t(i));
  }
  return kept;
}

template <class T>
std::vector<T> kept_values(const PointRecords& records, const std::optional<PointField>& field,
                           const std::vector<std::uint32_t>& kept) {
  if (!field) return {};
  const std::vector<double> all = column(records, *field);
  std::vector<T> values(kept.size());
  for (std::size_t i = 0; i < kept.size(); ++i) values[i] = T(all[kept[i]]);
  return values;
}

}  // namespace

std::string name_of(FieldType type) {
  static constexpr std::array<const char*, 10> names{"i8",  "u8",  "i16", "u16", "i32",
                                                     "u32", "i64", "u64", "f32", "f64"};
  return names[std::size_t(type)];
}

PointFieldRoles roles_of(const PointRecords& records) {
  return {coordinate(records, "x"),
          coordinate(records, "y"),
          coordinate(records, "z"),
          first_of(records, {"intensity", "i", "intensities", "reflectivity", "reflectance"}),
          first_of(records, {"ring", "line", "channel", "laser_id", "laserid", "laser_number"}),
          first_of(records, {"t", "time", "timestamp", "time_stamp", "offset_time", "timeoffset"})};
}

MeasuredPoints measured_points(const PointRecords& records, const PointFieldRoles& roles) {
  MeasuredPoints measured;
  const std::array<std::vector<double>, 3> xyz{column(records, roles.x), column(records, roles.y),
                                               column(records, roles.z)};
  const std::vector<std::uint32_t> kept = with_return(xyz, measured);
  if (kept.empty()) {
    throw Error("points", "none of " + std::to_string(records.count) +
                              " is valid: " + std::to_string(measured.not_finite) + " not finite, " +
                              std::to_string(measured.no_return) + " at (0, 0, 0)");
  }
  measured.points.reserve(kept.size());
  for (const std::uint32_t i : kept) measured.points.emplace_back(xyz[0][i], xyz[1][i], xyz[2][i]);
  measured.intensities = kept_values<float>(records, roles.intensity, kept);
  measured.ring_values = kept_values<double>(records, roles.ring, kept);
  measured.time_values = kept_values<double>(records, roles.time, kept);
  return measured;
}

}  // namespace tilth
