// The shapes of runs of neighbouring beams taken together, as many sets of runs at once as the processor has lanes
// (Highway): a few times as fast as one after another, and the same to the last bit. O(sets).
#pragma once

#include <array>
#include <span>

#include <tilth/features/moments.hpp>

namespace tilth {

/// Up to three runs, nullptr where there is none; the first is one.
using RunSet = std::array<const Moments*, 3>;

struct PlaneShape {
  Symmetric3d covariance;     ///< [m^2] of all points
  Eigen::Vector3d variances;  ///< [m^2] its eigenvalues, ascending
};

/// The shape of each set; as many `shapes`.
void join_runs(std::span<const RunSet> sets, std::span<PlaneShape> shapes);

}  // namespace tilth
