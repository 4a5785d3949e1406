#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include <tilth/core/error.hpp>
#include <tilth/io/las.hpp>
#include <tilth/io/output_file.hpp>

namespace tilth {
namespace {

constexpr std::size_t kHeaderSize = 375, kRecordSize = 54, kPointSize = 30;

class Writer {
 public:
  void number(std::size_t size, std::uint64_t value) {
    for (std::size_t i = 0; i < size; ++i) bytes_.push_back(std::byte(value >> 8 * i & 0xFF));
  }
  void f64(double value) { number(8, std::bit_cast<std::uint64_t>(value)); }
  void text(std::size_t size, std::string_view value) {
    for (std::size_t i = 0; i < size; ++i) bytes_.push_back(std::byte(i < value.size() ? value[i] : 0));
  }
  const std::vector<std::byte>& bytes() const { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
};

using Column = std::vector<double>;

Column optional_column(const PointRecords& records, std::string_view name) {
  const PointField* field = records.find(name);
  return field != nullptr ? column(records, *field) : Column{};
}

Column needed_column(const PointRecords& records, std::string_view name) {
  if (records.find(name) == nullptr) throw Error("LAS", "needs the field " + std::string(name));
  return optional_column(records, name);
}

struct Extent {
  std::array<double, 3> min{}, max{}, offset{};  // [m]
};

/// Of the points at `kept`.
Extent extent_of(const std::array<Column, 3>& xyz, const std::vector<std::size_t>& kept) {
  Extent extent;
  for (std::size_t axis = 0; axis < 3 && !kept.empty(); ++axis) {
    const auto less = [&](std::size_t a, std::size_t b) { return xyz[axis][a] < xyz[axis][b]; };
    const auto [min, max] = std::minmax_element(kept.begin(), kept.end(), less);
    extent.min[axis] = xyz[axis][*min], extent.max[axis] = xyz[axis][*max];
    extent.offset[axis] = std::round(0.5 * (extent.min[axis] + extent.max[axis]));
    constexpr double kWidest = 2.0 * kLasStep * (std::numeric_limits<std::int32_t>::max() - 1.0);
    if (extent.max[axis] - extent.min[axis] + 2.0 > kWidest)
      throw Error("LAS", "holds no cloud of " + std::to_string(extent.max[axis] - extent.min[axis]) + " m");
  }
  return extent;
}

/// The coordinates of all points, in UTM where an origin is given.
std::array<Column, 3> coordinates(const PointRecords& records, const std::optional<UtmOrigin>& origin) {
  std::array<Column, 3> xyz{needed_column(records, "x"), needed_column(records, "y"), needed_column(records, "z")};
  for (std::size_t i = 0; origin && i < records.count; ++i) {
    const Eigen::Vector3d p = origin->T_utm_world * Eigen::Vector3d(xyz[0][i], xyz[1][i], xyz[2][i]);
    for (std::size_t axis = 0; axis < 3; ++axis) xyz[axis][i] = p[Eigen::Index(axis)];
  }
  return xyz;
}

/// The public header block, table 3 of the specification, and the one record that follows it: the coordinate reference
/// system (tables 9 and 24).
Writer header_of(std::uint64_t points, const Extent& extent, const std::string& crs) {
  constexpr std::uint64_t kTextIsWkt = 0x10;
  Writer header;
  header.text(4, "LASF");
  header.number(2, 0);           // file source
  header.number(2, kTextIsWkt);  // global encoding, as format 6 asks for
  header.text(16, "");           // project
  header.number(1, 1), header.number(1, 4);
  header.text(32, "Tilth");
  header.text(32, "Tilth");
  header.number(2, 0), header.number(2, 0);  // no day and year: the same map has the same bytes
  header.number(2, kHeaderSize);
  header.number(4, kHeaderSize + kRecordSize + crs.size() + 1);  // to the points
  header.number(4, 1);                                           // variable length records
  header.number(1, 6), header.number(2, kPointSize);
  for (int i = 0; i < 6; ++i) header.number(4, 0);  // counts of old formats
  for (int i = 0; i < 3; ++i) header.f64(kLasStep);
  for (const double offset : extent.offset) header.f64(offset);
  for (std::size_t axis = 0; axis < 3; ++axis) header.f64(extent.max[axis]), header.f64(extent.min[axis]);
  for (int i = 0; i < 2; ++i) header.number(8, 0);  // no waveforms, no extended records
  header.number(4, 0);
  header.number(8, points);
  header.number(8, points);  // all of them first returns
  for (int i = 0; i < 14; ++i) header.number(8, 0);
  constexpr std::uint64_t kCrsAsText = 2112;
  header.number(2, 0);
  header.text(16, "LASF_Projection");
  header.number(2, kCrsAsText), header.number(2, crs.size() + 1);
  header.text(32, "WKT");
  header.text(crs.size() + 1, crs);
  return header;
}

std::uint64_t rounded(const Column& values, std::size_t i, double most) {
  return i < values.size() && values[i] > 0.0 ? std::uint64_t(std::llround(std::min(values[i], most))) : 0;
}

}  // namespace

void write_las(const std::filesystem::path& path, const PointRecords& records, double stamp,
               const std::optional<UtmOrigin>& origin) {
  const std::array<Column, 3> xyz = coordinates(records, origin);
  const Column intensities = optional_column(records, "intensity"), rings = optional_column(records, "ring"),
               times = optional_column(records, "time");
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < records.count; ++i) {
    if (std::isfinite(xyz[0][i]) && std::isfinite(xyz[1][i]) && std::isfinite(xyz[2][i])) kept.push_back(i);
  }
  const Extent extent = extent_of(xyz, kept);
  OutputFile file(path);
  file.write(header_of(kept.size(), extent, well_known_text(origin)).bytes());
  Writer points;
  for (const std::size_t i : kept) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto steps = std::llround((xyz[axis][i] - extent.offset[axis]) / kLasStep);
      points.number(4, std::uint64_t(steps));
    }
    points.number(2, rounded(intensities, i, 65535.0));
    points.number(1, 0x11);  // the first return of one
    points.number(1, 0), points.number(1, 0);
    points.number(1, rounded(rings, i, 255.0));
    points.number(2, 0), points.number(2, 0);
    points.f64(i < times.size() ? stamp + times[i] : 0.0);
  }
  file.write(points.bytes());
  file.close();
}

}  // namespace tilth
