// Continuous-time registration, of a scan that was taken in motion, by Gauss-Newton steps (docs/method.md): the pose in
// the middle of the scan and the velocity during it are estimated together, so that the scan is straightened by its own
// motion and not by that of the scan before.
#pragma once

#include <algorithm>
#include <optional>

#include <tilth/registration/motion_prior.hpp>
#include <tilth/registration/patch_pairs.hpp>
#include <tilth/registration/vibration.hpp>

namespace tilth {

/// What is known before a scan, for all of its steps.
struct ScanPrior {
  MotionPrior motion;
  std::optional<KnotMatrix> knots = {};  ///< precision of the vibration's; none: no vibration is estimated
};

/// Of a scan whose middle is `middle` [s] after its stamp.
ScanPrior scan_prior(const MotionPrior& motion, double middle, const ContinuousTimeOptions& options);

/// One Gauss-Newton step of `state` on `pairs` and the prior, with the diagnosis of the pairs; false where there are
/// too few pairs or no solution.
bool gauss_newton_step(const PatchPairs& pairs, const ScanPrior& prior, const ContinuousTimeOptions& options,
                       MotionState& state, ContinuousTimeAlignment& result);

/// Where the motion expected leads to, `middle` [s] after the stamp of the scan.
inline MotionState expected_state(const MotionPrior& prior, double middle) {
  return {predicted(prior), MotionInScan::steady(prior.velocity, middle), middle};
}

/// The state at which the patches agree with the map, and the prior, found from `start` on. Pairs are made anew in
/// every iteration; the kernel narrows from first_kernel_width to kernel_width (graduated non-convexity, Yang et al.
/// 2020). Too few pairs: the predicted pose comes back, not converged.
template <SurfaceMap Map>
ContinuousTimeAlignment align_continuous_time(const SurfacePatches& patches, const MotionState& start,
                                              const MotionPrior& prior, const Map& map,
                                              const ContinuousTimeOptions& options) {
  MotionState state = start;
  state.kernel_width = std::max(options.first_kernel_width, options.kernel_width);
  ContinuousTimeAlignment result{.pose = {.T_target_source = state.T_map_lidar},
                                 .motion = state.motion,
                                 .covariance = pose_variances(prior, options).asDiagonal()};
  result.pose.candidates = patches.size();
  const ScanPrior before = scan_prior(prior, start.middle, options);
  PatchMatching<SurfaceOf<Map>> matching;
  while (result.pose.iterations < options.max_iterations && !result.pose.converged) {
    associate_patches(patches, state, map, options, matching);
    if (!gauss_newton_step(matching.pairs, before, options, state, result)) return result;
    result.pose.converged &= state.kernel_width <= options.kernel_width;
    state.kernel_width = std::max(options.kernel_width, state.kernel_width / 2);
  }
  result.pose.T_target_source = state.T_map_lidar;
  result.motion = state.motion;
  return result;
}

/// From the motion expected on; `middle` [s] of the scan is after its stamp.
template <SurfaceMap Map>
ContinuousTimeAlignment align_continuous_time(const SurfacePatches& patches, double middle, const MotionPrior& prior,
                                              const Map& map, const ContinuousTimeOptions& options) {
  return align_continuous_time(patches, expected_state(prior, middle), prior, map, options);
}

}  // namespace tilth
