// Whether poses are as good as they say: the normalised estimation error squared (NEES; Bar-Shalom, Li and Kirubarajan,
// Estimation with Applications to Tracking and Navigation, 2001, section 5.4). O(poses).
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include <tilth/core/se3.hpp>
#include <tilth/evaluation/associate.hpp>

namespace tilth {

struct Consistency {
  std::size_t poses = 0;   ///< that had a variance in each direction
  double mean_nees = 0.0;  ///< [-] 6 where the variances are right, more where they promise too much
  double inside = 0.0;     ///< [-] share of the poses whose NEES lies within the 95 % bounds of chi^2 with 6 dof
};

/// `variances` are those of the estimate's poses [rad^2, m^2] in the frame of the first one, along the axes of the
/// LiDAR: an error is log(T_estimate^-1 T_truth), the first poses made equal, its NEES the sum of its squares over
/// them. Poses without a positive variance in each direction do not count. Throws Error where the lengths differ.
Consistency consistency(const MatchedPoses& matches, std::span<const Vector6d> variances);

/// Between which 95 % of the means of `count` independent NEES lie (Wilson and Hilferty's chi^2).
std::array<double, 2> mean_nees_bounds(std::size_t count);

}  // namespace tilth
