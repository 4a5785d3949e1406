#include <algorithm>
#include <cmath>

#include <tilth/calibration/surface_cells.hpp>
#include <tilth/calibration/surface_rows.hpp>

namespace tilth {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kFewestBeams = 3, kFewestKeyframes = 3;

SurfacePoint surface_point(const BeamKeyframe& keyframe, const ScanMotion& motion, const BeamModel& beams,
                           const BeamReturn& r) {
  const Vector3d measured = r.point.cast<double>();
  const Vector3d direction = true_direction(beams, r.ring, measured.normalized());
  const double dim = dimness(r.intensity, beams.bright);
  const double range = true_range(beams, r.ring, measured.norm(), dim);
  const double level = std::max(std::hypot(direction.x(), direction.y()), 1e-9);
  const Vector3d up(-direction.z() * direction.x() / level, -direction.z() * direction.y() / level, level);
  const Eigen::Matrix3d R = keyframe.T_map_lidar.linear() * motion.rotation(r.time);
  SurfacePoint p;
  p.point = keyframe.T_map_lidar * motion.move(range * direction, r.time);
  p.by_range = R * direction;
  p.by_elevation = R * (range * up);
  p.by_azimuth = R * Vector3d(-range * direction.y(), range * direction.x(), 0);
  p.harmonics = encoder_harmonics(measured);
  p.dim = dim, p.ring = r.ring, p.count = r.count;
  return p;
}

std::vector<SurfacePoint> surface_points(std::span<const BeamKeyframe> keyframes, const BeamModel& beams) {
  std::vector<SurfacePoint> points;
  for (std::size_t k = 0; k < keyframes.size(); ++k) {
    const ScanMotion motion(keyframes[k].motion, keyframes[k].reference_time);
    for (const BeamReturn& r : keyframes[k].returns) {
      points.push_back(surface_point(keyframes[k], motion, beams, r));
      points.back().keyframe = std::uint16_t(k);
    }
  }
  return points;
}

/// What a surface says of an angle is shrunk where the beam hits it nearly along the direction that the angle moves it.
double doubted(double derivative, double lever, double doubt) {
  const double sine = std::abs(derivative) / std::max(lever, 1e-9);
  return derivative / (1 + std::pow(doubt / std::max(sine, 1e-9), 4));
}

void add(SurfaceRow& row, const SurfacePoint& p, const SurfaceCell& cell, const Vector3d& place,
         const BeamCalibrationOptions& o) {
  const Vector3d d = p.point - cell.mean;
  const double by_range = cell.normal.dot(p.by_range);
  row.count += p.count;
  row.distance += p.count * cell.normal.dot(d);
  row.by_range += p.count * by_range;
  row.by_walk += p.count * p.dim * by_range;
  row.by_elevation += p.count * doubted(cell.normal.dot(p.by_elevation), p.by_elevation.norm(), o.doubt);
  row.by_encoder += p.count * doubted(cell.normal.dot(p.by_azimuth), p.by_azimuth.norm(), o.doubt) * p.harmonics;
  row.by_pose.head<3>() += p.count * (p.point - place).cross(cell.normal);
  row.by_pose.tail<3>() += p.count * cell.normal;
  row.along += p.count * cell.along.dot(d) / o.cell;
  row.across += p.count * cell.across.dot(d) / o.cell;
}

void divide(SurfaceRow& row) {
  const double n = row.count;
  row.distance /= n, row.by_range /= n, row.by_elevation /= n, row.by_walk /= n, row.along /= n, row.across /= n;
  row.by_encoder /= n, row.by_pose /= n;
}

/// Whether three beams and three keyframes see the cell whose rows these are.
bool various(std::span<const SurfaceRow> rows) {
  std::vector<std::uint16_t> beams, keyframes;
  for (const SurfaceRow& row : rows) beams.push_back(row.ring), keyframes.push_back(row.keyframe);
  const auto distinct = [](std::vector<std::uint16_t>& v) {
    std::sort(v.begin(), v.end());
    return std::size_t(std::unique(v.begin(), v.end()) - v.begin());
  };
  return distinct(beams) >= kFewestBeams && distinct(keyframes) >= kFewestKeyframes;
}

/// Drops the cells that too few beams or keyframes see, and numbers the others anew.
SurfaceRows seen_by_various(std::vector<SurfaceRow> rows, const std::vector<SurfaceCell>& cells) {
  SurfaceRows result;
  for (std::size_t i = 0; i < rows.size();) {
    std::size_t end = i;
    while (end < rows.size() && rows[end].cell == rows[i].cell) ++end;
    if (various(std::span(rows).subspan(i, end - i))) {
      const auto number = std::uint32_t(result.thickness.size());
      result.thickness.push_back(cells[rows[i].cell].thickness);
      for (std::size_t j = i; j < end; ++j) {
        rows[j].cell = number;
        result.rows.push_back(rows[j]);
      }
    }
    i = end;
  }
  return result;
}

}  // namespace

SurfaceRows surface_rows(std::span<const BeamKeyframe> keyframes, const BeamModel& beams,
                         const BeamCalibrationOptions& options) {
  std::vector<SurfacePoint> points = surface_points(keyframes, beams);
  const Vector3d origin = keyframes.front().T_map_lidar.translation();
  const std::vector<SurfaceCell> cells = find_surface_cells(points, origin, options);
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (points[i].cell != VoxelTable::kNone) order.push_back(i);
  }
  const auto key = [&](std::uint32_t i) {
    const SurfacePoint& p = points[i];
    return std::uint64_t(p.cell) << 32 | std::uint64_t(p.keyframe) << 16 | p.ring;
  };
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  std::vector<SurfaceRow> rows;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const SurfacePoint& p = points[order[i]];
    if (i == 0 || key(order[i]) != key(order[i - 1])) {
      if (!rows.empty()) divide(rows.back());
      rows.push_back({p.cell, p.keyframe, p.ring, 0, 0, 0, 0, 0, Eigen::Vector4d::Zero(), Vector6d::Zero(), 0, 0});
    }
    add(rows.back(), p, cells[p.cell], keyframes[p.keyframe].T_map_lidar.translation(), options);
  }
  if (!rows.empty()) divide(rows.back());
  return seen_by_various(std::move(rows), cells);
}

}  // namespace tilth
