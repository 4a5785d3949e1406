// Which pose of the truth belongs to which pose of the estimate: by nearest stamp (as evo does), by interpolation, by
// index. Cost: O(n log n) for n poses.
#pragma once

#include <vector>

#include <tilth/core/trajectory.hpp>

namespace tilth {

/// A gap of the truth too long to be interpolated over, and the poses of the estimate left out for it.
struct TruthGap {
  double from = 0.0, to = 0.0;  ///< [s] stamps of the poses at its ends
  std::size_t left_out = 0;
};

/// Poses that belong together: truth[i] and estimate[i], of equal number. Each keeps its own stamp.
struct MatchedPoses {
  Trajectory truth, estimate;
  std::vector<TruthGap> gaps{};  ///< where the truth was interpolated: in their order
};

struct StampAssociationOptions {
  double max_dt = 0.01;      ///< [s] largest difference of two stamps that match
  double time_offset = 0.0;  ///< [s] added to the estimate's stamps before they are compared
  bool interpolate = false;  ///< truth interpolated at the estimate's stamps; then max_dt is not used
  double max_gap = 0.0;      ///< [s] between poses of the truth that are interpolated; 0: see gap_limit
};

/// [s] the longest gap of `truth` that is interpolated over: max_gap, or where that is 0 three times the median
/// interval, at least 0.2 s.
double gap_limit(const Trajectory& truth, const StampAssociationOptions& options);

/// Matches as the options say. By nearest stamp, each pose of the trajectory with fewer poses (of the estimate, where
/// they have equally many) takes the pose of the other whose stamp is nearest, the earlier one of two equally near;
/// that one may be taken more than once. Interpolated, each pose of the estimate between the truth's first and last
/// stamp takes the pose on the straight line, and of the shortest rotation, between its two neighbours, unless these
/// lie further apart than gap_limit and neither has its stamp. Throws Error with both time ranges where nothing
/// matches, and where either trajectory is empty.
MatchedPoses associate(const Trajectory& truth, const Trajectory& estimate, const StampAssociationOptions& options);

/// Matches the i-th pose with the i-th pose. Throws Error unless there are equally many.
MatchedPoses associate_by_index(const Trajectory& truth, const Trajectory& estimate);

}  // namespace tilth
