// Which pose of the truth belongs to which pose of the estimate: by nearest stamp (as evo does), by interpolation, by
// index. Cost: O(n log n) for n poses.
#pragma once

#include <tilth/core/trajectory.hpp>

namespace tilth {

/// Poses that belong together: truth[i] and estimate[i], of equal number. Each keeps its own stamp.
struct MatchedPoses {
  Trajectory truth, estimate;
};

struct StampAssociationOptions {
  double max_dt = 0.01;      ///< [s] largest difference of two stamps that match
  double time_offset = 0.0;  ///< [s] added to the estimate's stamps before they are compared
  bool interpolate = false;  ///< truth interpolated at the estimate's stamps; then max_dt is not used
};

/// Matches as the options say. By nearest stamp, each pose of the trajectory with fewer poses (of the estimate, where
/// they have equally many) takes the pose of the other whose stamp is nearest, the earlier one of two equally near;
/// that one may be taken more than once. Interpolated, each pose of the estimate between the truth's first and last
/// stamp takes the pose on the straight line, and of the shortest rotation, between its two neighbours. Throws Error
/// with both time ranges where nothing matches, and where either trajectory is empty.
MatchedPoses associate(const Trajectory& truth, const Trajectory& estimate, const StampAssociationOptions& options);

/// Matches the i-th pose with the i-th pose. Throws Error unless there are equally many.
MatchedPoses associate_by_index(const Trajectory& truth, const Trajectory& estimate);

}  // namespace tilth
