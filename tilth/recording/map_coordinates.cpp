#include <cmath>
#include <cstdio>
#include <limits>

#include <tilth/core/error.hpp>
#include <tilth/recording/coordinate_offset.hpp>
#include <tilth/recording/map_coordinates.hpp>
#include <tilth/recording/record_edit.hpp>

namespace tilth {
namespace {

constexpr std::size_t kSample = 8192;  ///< points of a scan that tell where its sensor is
constexpr double kCoarsest = 0.02;     ///< between two numbers that coordinates can be
constexpr double kMoved = 0.3;         ///< between the first and the last of the first scans

std::string text(const char* format, auto... values) {
  char line[320];
  std::snprintf(line, sizeof line, format, values...);
  return line;
}

/// Seen from `offset`; nothing where no rings tell it.
std::optional<Eigen::Vector3d> apex_of(const PointRecords& records, const Eigen::Vector3d& offset,
                                       const RingValues& valid) {
  const PointRecords sample = sampled_records(records, kSample);
  const PointFieldRoles roles = roles_of(sample);
  if (!roles.ring) return std::nullopt;
  const std::vector<double> rings = column(sample, *roles.ring);
  const ValueCheck check = valid.check(rings);
  const std::vector<Eigen::Vector3d> all = coordinates_of(sample, roles);
  std::vector<Eigen::Vector3d> points;
  std::vector<std::uint16_t> kept;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool good = check.keep.empty() ? rings[i] >= 0.0 && rings[i] < 1024.0 : check.keep[i] != 0;
    if (!good || !all[i].allFinite() || all[i].isZero(0.0)) continue;
    points.push_back(all[i] - offset);
    kept.push_back(std::uint16_t(rings[i]));
  }
  return apex_of_rings(points, kept);
}

/// Of scans whose points all lie far away; throws Error where the numbers cannot tell them apart there.
void check_digits(const PointRecords& records, const Eigen::Vector3d& offset) {
  if (roles_of(records).x.type != FieldType::f32) return;
  const float far = float(offset.cwiseAbs().maxCoeff());
  const double step = double(std::nextafter(far, std::numeric_limits<float>::infinity())) - double(far);
  if (step < kCoarsest) return;
  throw Error("coordinates",
              text("are about %.0f, where float32 has steps of %g: the shape of the scans is lost. Subtract an offset "
                   "before they are written, or write doubles",
                   double(far), step));
}

}  // namespace

std::optional<MapCoordinates> map_coordinates(std::span<const PointRecords> first, const RingValues& rings) {
  const std::optional<Eigen::Vector3d> far = far_offset(measured_sample(first.front(), kSample));
  if (!far) return std::nullopt;
  check_digits(first.front(), *far);
  const Eigen::Vector3d offset = far->array().round();
  const std::optional<Eigen::Vector3d> apex = apex_of(first.front(), offset, rings);
  const std::optional<Eigen::Vector3d> last = apex ? apex_of(first.back(), offset, rings) : std::nullopt;
  if (last && (*last - *apex).norm() > kMoved) {
    throw Error("coordinates", text("are those of a map, in which the sensor moves by %.2f m within the first %zu "
                                    "scans: there is no motion to find. Give the scans as the sensor saw them",
                                    (*last - *apex).norm(), first.size()));
  }
  const Eigen::Vector3d sensor = apex ? Eigen::Vector3d(offset + *apex) : offset;
  const std::string where = apex ? "there the beams of all rings meet"
                                 : "where the sensor is in them is not known, and poses are those of that point";
  return MapCoordinates{sensor, text("offset: coordinates lie about (%.3f, %.3f, %.3f), which is subtracted; ",
                                     sensor.x(), sensor.y(), sensor.z()) +
                                    where};
}

}  // namespace tilth
