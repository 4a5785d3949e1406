// The metric of the KITTI odometry benchmark: drift over segments of 100, 200 ... 800 m of the truth's path (A. Geiger,
// P. Lenz, R. Urtasun, "Are we ready for autonomous driving?", CVPR 2012, and its development kit). O(n log n).
#pragma once

#include <vector>

#include <tilth/evaluation/associate.hpp>

namespace tilth {

/// The drift over one segment, or the mean over several.
struct SegmentError {
  double length = 0.0;       ///< [m]
  double translation = 0.0;  ///< [-] of the length; times 100 in percent
  double rotation = 0.0;     ///< [rad/m]
};

struct KittiMetric {
  double translation = 0.0;             ///< [-] mean over all segments
  double rotation = 0.0;                ///< [rad/m] mean over all segments
  std::vector<SegmentError> segments;   ///< by first pose, then length
  std::vector<SegmentError> by_length;  ///< mean over the segments of each length that occurs, ascending
};

/// Segments begin at every 10th pose and end at the first pose whose path from there is longer than the segment. Throws
/// Error where the truth's path is too short for one.
KittiMetric kitti_metric(const MatchedPoses& matches);

}  // namespace tilth
