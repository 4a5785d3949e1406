// Which poses of a trajectory are compared with which later ones: pairs a number of frames, metres or seconds apart.
// Frames and metres as evo picks them. O(n) for frames, O(n log n) else.
#pragma once

#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include <tilth/core/trajectory.hpp>

namespace tilth {

enum class DeltaUnit { frames, meters, seconds };

constexpr std::array<std::string_view, 3> kDeltaUnitNames{"frames", "m", "s"};
inline const auto& names_of(DeltaUnit) {
  return kDeltaUnitNames;
}

struct PairOptions {
  double delta = 1.0;  ///< [unit] from the first pose of a pair to the second; metres along the path
  DeltaUnit unit = DeltaUnit::frames;
  bool all_pairs = false;  ///< a pair from every pose; else each pair begins where the last one ends
  double tolerance = 0.1;  ///< [-] of delta: how far a pair may miss it; of metres with all_pairs, and of seconds
};

using PosePair = std::pair<std::size_t, std::size_t>;

/// Frames: (i, i + delta). Metres, consecutive: the first pose at which the path since the last pair is delta or
/// longer; all pairs: the pose whose path from i is nearest to delta. Seconds: the pose whose stamp is nearest to that
/// of i plus delta; consecutive pairs go on from the next pose where there is none. Throws Error where delta is not
/// positive (or no whole number of frames), and where there is no such pair.
std::vector<PosePair> pose_pairs(const Trajectory& trajectory, const PairOptions& options);

}  // namespace tilth
