// The verdict on a map without truth, in words. docs/assess.md says what it can tell and what it cannot.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <tilth/assessment/doubled_walls.hpp>
#include <tilth/assessment/map_quality.hpp>
#include <tilth/core/track_state.hpp>

namespace tilth {

/// A scan of the run that made the map.
struct AssessedScan {
  double stamp = 0.0;  ///< [s]
  TrackState track = TrackState::tracking;
};

struct MapAssessment {
  MapQuality quality;
  DoubledWalls doubled;
  std::size_t scans = 0, not_tracked = 0;  ///< `not_tracked`: coasting or lost
  std::vector<std::string> findings;       ///< what to look at, the worst first

  std::string verdict() const;  ///< "good", or the findings
};

/// Of the points of a map, and the scans that they count by. No points: "the map is empty".
MapAssessment assess_map(std::span<const ScannedPoint> points, std::span<const AssessedScan> scans);

}  // namespace tilth
