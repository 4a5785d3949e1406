// Where a scan may be when the motion expected cannot be trusted: at a start in motion, after a gap, in a turn that
// sets in at once. Poses to begin a registration from, coarse to fine, and which of the registrations is to be taken.
#pragma once

#include <span>
#include <vector>

#include <tilth/core/surface_patch.hpp>
#include <tilth/map/patch_map.hpp>
#include <tilth/registration/align_result.hpp>
#include <tilth/registration/pose_search.hpp>

namespace tilth {

inline constexpr double kPredictable = 1.0;      ///< [s] within which the motion expected is the likeliest
inline constexpr double kMapGivenUp = 3.0;       ///< [s] without a scan that fits it: a new map is begun
inline constexpr double kSureFit = 0.9;          ///< of the first pair of scans, that need not be tried elsewhere
inline constexpr double kClearlyBetter = 1.03;   ///< times the fit
inline constexpr std::size_t kFewPatches = 300;  ///< that hypotheses are tried on
inline constexpr int kFewIterations = 15;        ///< that they are tried with
inline constexpr double kFewEpsilon = 1e-3;      ///< [m, rad] step at which these stop

/// How far a robot may be from where it was expected after `interval` [s], when it moved at `speed` [m/s] before.
SearchWindow window_after(double interval, double speed);

/// How far a robot may be from where it was `interval` [s] before, if nothing is known of its motion.
SearchWindow window_at_start(double interval);

std::vector<FacingPoint> facing_points(const SurfacePatches& patches);
/// Of the surfaces that have a normal.
std::vector<FacingPoint> facing_points(const PatchMap& map);

/// The pose expected, the last one, and the best candidates that the map has for `seen` about the first of them.
std::vector<Pose> poses_to_try(const PatchMap& map, const SurfacePatches& seen, const Pose& T_map_expected,
                               const Pose& T_map_last, const SearchWindow& window);

/// Which of the registrations fits best, and whether it can be told from the others.
struct Choice {
  std::size_t best = 0;
  bool ambiguous = false;  ///< another pose fits about as well
};

/// Of registrations of the same patches, not empty. Those that ended at the pose of the best one are no others.
Choice choose(std::span<const AlignResult> registrations);

}  // namespace tilth
