// A LiDAR spinning in a box-shaped room, and records of what it sees in the formats of drivers.
#pragma once

#include <cmath>
#include <cstring>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <tilth/core/point_records.hpp>

namespace tilth {

struct Shot {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  int ring = 0;       ///< 0 = lowest
  double time = 0.0;  ///< [s] since the start of the recording
};

struct Spin {
  std::vector<double> elevations_deg;
  double period = 0.1;     ///< [s]
  double start_deg = 170;  ///< azimuth at `start`
  double covered_deg = 360;
  bool clockwise = true;
  double start = 0.0;  ///< [s]
  int columns = 600;   ///< a turn
};

inline std::vector<double> beams_deg(int count, double lowest, double spacing) {
  std::vector<double> beams;
  for (int b = 0; b < count; ++b) beams.push_back(lowest + spacing * b);
  return beams;
}

/// Distance to the walls of a room of 16 x 10 x 4 m.
inline double range_in_room(const Eigen::Vector3d& direction) {
  const Eigen::Vector3d half(8, 5, 2);
  double range = 100.0;
  for (int axis = 0; axis < 3; ++axis) range = std::min(range, half[axis] / std::max(std::abs(direction[axis]), 1e-9));
  return range;
}

/// Shots in firing order; odd beams fire after the even ones, as in a VLP-16.
inline std::vector<Shot> shots_of(const Spin& spin) {
  constexpr double degree = std::numbers::pi / 180.0;
  const int beams = int(spin.elevations_deg.size());
  const int columns = int(spin.columns * spin.covered_deg / 360.0);
  const double firing = spin.period / spin.columns;
  std::vector<Shot> shots;
  for (int column = 0; column < columns; ++column) {
    for (int slot = 0; slot < beams; ++slot) {
      const int ring = slot < (beams + 1) / 2 ? 2 * slot : 2 * (slot - (beams + 1) / 2) + 1;
      const double since = (column + 0.9 * slot / beams) * firing;
      const double turned = 360.0 * since / spin.period;
      const double azimuth = (spin.start_deg + (spin.clockwise ? -turned : turned)) * degree;
      const double elevation = spin.elevations_deg[std::size_t(ring)] * degree;
      const Eigen::Vector3d direction(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                                      std::sin(elevation));
      shots.push_back({range_in_room(direction) * direction, ring, spin.start + since});
    }
  }
  return shots;
}

using FieldValue = std::function<double(const Shot&)>;

struct RecordField {
  std::string name;
  FieldType type;
  FieldValue value;
};

inline RecordField coordinate_field(int axis, FieldType type = FieldType::f32) {
  return {std::string(1, "xyz"[axis]), type, [axis](const Shot& s) { return s.point[axis]; }};
}

inline void store(double value, FieldType type, std::byte* to) {
  const auto put = [to](auto typed) { std::memcpy(to, &typed, sizeof typed); };
  switch (type) {
    case FieldType::i8: return put(std::int8_t(value));
    case FieldType::u8: return put(std::uint8_t(value));
    case FieldType::i16: return put(std::int16_t(value));
    case FieldType::u16: return put(std::uint16_t(value));
    case FieldType::i32: return put(std::int32_t(value));
    case FieldType::u32: return put(std::uint32_t(value));
    case FieldType::i64: return put(std::int64_t(value));
    case FieldType::u64: return put(std::uint64_t(value));
    case FieldType::f32: return put(float(value));
    case FieldType::f64: return put(value);
  }
}

/// x y z as float32, then `more`, packed; little-endian as the machine is.
inline PointRecords records_of(const std::vector<Shot>& shots, const std::vector<RecordField>& more) {
  std::vector<RecordField> all{coordinate_field(0), coordinate_field(1), coordinate_field(2)};
  all.insert(all.end(), more.begin(), more.end());
  PointRecords records;
  for (const RecordField& field : all) {
    records.fields.push_back({field.name, field.type, records.stride});
    records.stride += size_of(field.type);
  }
  records.count = shots.size();
  records.bytes.resize(records.count * records.stride);
  for (std::size_t i = 0; i < shots.size(); ++i) {
    for (std::size_t f = 0; f < all.size(); ++f) {
      store(all[f].value(shots[i]), all[f].type, records.bytes.data() + i * records.stride + records.fields[f].offset);
    }
  }
  return records;
}

inline RecordField ring_field(const std::string& name = "ring", FieldType type = FieldType::u16) {
  return {name, type, [](const Shot& s) { return double(s.ring); }};
}

inline RecordField intensity_field() {
  return {"intensity", FieldType::f32, [](const Shot& s) { return 10.0 * s.ring; }};
}

}  // namespace tilth
