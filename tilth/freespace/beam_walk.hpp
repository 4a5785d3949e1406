// The cells of a regular grid that a beam passes, in order (J. Amanatides and A. Woo, A fast voxel traversal algorithm
// for ray tracing, Eurographics 1987). A few operations a cell.
#pragma once

#include <cmath>
#include <limits>

#include <Eigen/Core>

#include <tilth/core/voxel_table.hpp>

namespace tilth {

/// A stretch of a beam in the world: from `begin` to `end` [m] along `direction`, of length 1, from `origin`.
struct BeamStretch {
  Eigen::Vector3f origin, direction;
  float begin = 0.0F, end = 0.0F;
};

/// Calls visit(cell, along) for each cell of edge `cell` [m] that the stretch passes, `along` [m] where it enters it.
template <class F>
void walk(const BeamStretch& beam, float cell, const F& visit) {
  const Eigen::Vector3f start = beam.origin + beam.begin * beam.direction;
  Eigen::Vector3i at = voxel_of((start / cell).cast<double>()), step;
  Eigen::Vector3f next, width;
  for (int a = 0; a < 3; ++a) {
    const float d = beam.direction[a];
    step[a] = d > 0 ? 1 : -1;
    const bool level = std::abs(d) < 1e-9F;
    width[a] = level ? std::numeric_limits<float>::infinity() : cell / std::abs(d);
    next[a] = level ? width[a] : beam.begin + (float(at[a] + (d > 0 ? 1 : 0)) * cell - start[a]) / d;
  }
  for (float along = beam.begin; along < beam.end;) {
    visit(at, along);
    const int a = next.x() < next.y() ? (next.x() < next.z() ? 0 : 2) : (next.y() < next.z() ? 1 : 2);
    along = next[a];
    next[a] += width[a];
    at[a] += step[a];
  }
}

}  // namespace tilth
