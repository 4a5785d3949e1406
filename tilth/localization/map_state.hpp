// What is known of where a LiDAR is in a map.
#pragma once

#include <array>
#include <span>
#include <string_view>

namespace tilth {

enum class MapState {
  searching,  ///< no place is known
  ambiguous,  ///< several places look alike
  located,    ///< the pose is known, and the scan fits the map there
  coasting,   ///< the pose is known by odometry; the map is not heard
  lost,       ///< the pose was wrong or is no longer known: it is looked for anew
};
inline std::span<const std::string_view> names_of(MapState) {
  static constexpr std::array<std::string_view, 5> names{"searching", "ambiguous", "located", "coasting", "lost"};
  return names;
}

/// Whether there is a pose in that state.
inline bool is_known(MapState state) {
  return state == MapState::located || state == MapState::coasting;
}

}  // namespace tilth
