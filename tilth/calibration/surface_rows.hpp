// Points of a window of keyframes as rows of a least-squares problem: what one beam of one keyframe sees of one flat
// cell of surface, and how its distance from the plane depends on the beam's errors and the keyframe's pose
// (docs/beams.md).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <tilth/calibration/beam_keyframe.hpp>
#include <tilth/calibration/beam_options.hpp>
#include <tilth/core/beam_model.hpp>

namespace tilth {

/// Means over the points of one beam of one keyframe in one cell.
struct SurfaceRow {
  std::uint32_t cell;
  std::uint16_t keyframe, ring;
  double count;                   ///< points
  double distance;                ///< [m] n . (x - c)
  double by_range, by_elevation;  ///< [-], [m/rad] derivatives of -distance
  double by_walk;                 ///< [-]
  Eigen::Vector4d by_encoder;     ///< [m/rad]
  Vector6d by_pose;               ///< derivative of distance: turn about the keyframe's place, shift; in the map
  double along, across;           ///< [cells] where in the cell
};

struct SurfaceRows {
  std::vector<SurfaceRow> rows;   ///< by cell, ascending
  std::vector<double> thickness;  ///< [m] of each cell: deviation of its points from its plane
};

SurfaceRows surface_rows(std::span<const BeamKeyframe> keyframes, const BeamModel& beams,
                         const BeamCalibrationOptions& options);

}  // namespace tilth
