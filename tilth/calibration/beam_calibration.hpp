// What a calibration of beams found (docs/beams.md).
#pragma once

#include <cstddef>
#include <vector>

#include <tilth/core/beam_estimate.hpp>

namespace tilth {

/// How well surfaces and beams agree, at one model of the beams.
struct BeamFit {
  std::vector<double> residual;  ///< [m] of each beam: how long it reads, about the planes; NaN: it saw none
  double thickness = 0.0;        ///< [m] median deviation of a surface's points from its plane
};

struct BeamCalibration {
  BeamEstimate beams;
  BeamFit before, after;
  std::size_t windows = 0, keyframes = 0, rows = 0;
  std::size_t directions = 0, believed = 0;  ///< of the parameters' space: all, and those in which errors were found
};

}  // namespace tilth
