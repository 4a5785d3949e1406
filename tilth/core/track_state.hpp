// Whether a pose is to be believed: what the odometry says of its own track, scan by scan.
#pragma once

#include <array>
#include <span>
#include <string_view>

namespace tilth {

enum class TrackState {
  tracking,   ///< registered, and it fits
  coasting,   ///< predicted only, for a short while
  lost,       ///< wrong, or likely so; what follows is right only relative to itself
  recovered,  ///< found again where the map of before the loss says
};
inline std::span<const std::string_view> names_of(TrackState) {
  static constexpr std::array<std::string_view, 4> names{"tracking", "coasting", "lost", "recovered"};
  return names;
}

/// Why a track is not `tracking`.
enum class TrackReason { none, too_few_matches, poor_fit, jump, long_gap, ambiguous, new_map, joined };
inline std::span<const std::string_view> names_of(TrackReason) {
  static constexpr std::array<std::string_view, 8> names{
      "",
      "too little of the scan is found in the map",
      "the scan does not fit the map",
      "the motion leaps",
      "no scans for too long",
      "several motions fit alike",
      "registered to a map that was begun after the loss",
      "the map begun after the loss was joined to the one before it",
  };
  return names;
}

struct Track {
  TrackState state = TrackState::tracking;
  TrackReason reason = TrackReason::none;
};

}  // namespace tilth
