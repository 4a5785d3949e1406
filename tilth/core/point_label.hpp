// What is true of a point, where that is known: one byte each, as simulation writes it and the judges of filters read
// it.
#pragma once

#include <cstdint>

namespace tilth {

/// Where a point comes from. On file one byte: the kind, plus 128 where the point lies on an edge structure.
enum class PointKind : std::uint8_t { surface, outlier, mixed, ghost, moving };
inline constexpr std::uint8_t kEdgeBit = 0x80;

inline PointKind kind_of(std::uint8_t label) {
  return PointKind(label & ~kEdgeBit);
}
inline bool is_on_edge(std::uint8_t label) {
  return (label & kEdgeBit) != 0;
}

}  // namespace tilth
