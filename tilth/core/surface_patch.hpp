// A small piece of surface as a scan shows it (others call it surfel): what scans are registered by, and what maps are
// made of.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <tilth/core/se3.hpp>

namespace tilth {

struct SurfacePatch {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();        ///< [m] of the points of one beam
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< [m^2] of these and of those of the beams beside
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();      ///< unit, towards the sensor; of least extent where not flat
  float time = 0.0f;                                     ///< [s] since the stamp of the scan
  float thickness = 0.0f;                                ///< [m^2] variance along the normal
  std::uint16_t points = 1;                              ///< of which `mean` is the mean
  std::uint16_t ring = 0;                                ///< 0 = lowest beam
  bool flat = false;                                     ///< a piece of a plane; else a pole, an edge, a bush
};

using SurfacePatches = std::vector<SurfacePatch>;

}  // namespace tilth
