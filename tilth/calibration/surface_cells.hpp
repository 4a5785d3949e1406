// Flat cells of surface: points of a window of keyframes, by where they lie, and the plane of each cell.
#pragma once

#include <cstdint>
#include <vector>

#include <tilth/calibration/beam_options.hpp>
#include <tilth/core/symmetric3.hpp>
#include <tilth/core/voxel_table.hpp>

namespace tilth {

/// A return in the map, and how its errors move it there.
struct SurfacePoint {
  Eigen::Vector3d point;                               ///< [m]
  Eigen::Vector3d by_range, by_elevation, by_azimuth;  ///< [-], [m/rad], [m/rad]
  Eigen::Vector4d harmonics;
  double dim;
  double count;                            ///< returns that it is the mean of
  std::uint32_t cell = VoxelTable::kNone;  ///< of those that are flat
  std::uint16_t keyframe, ring;
};

struct SurfaceCell {
  double count = 0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();  ///< [m]
  Symmetric3d moments;                             ///< [m^2] summed, about the mean
  bool flat = false;
  double thickness = 0;
  Eigen::Vector3d normal, along, across;
};

/// The flat cells of two lattices, the second one half an edge beside the first; tells each point its cell.
std::vector<SurfaceCell> find_surface_cells(std::vector<SurfacePoint>& points, const Eigen::Vector3d& origin,
                                            const BeamCalibrationOptions& options);

}  // namespace tilth
