// Support across rings: upright things, if only one beam wide, are seen by beams one above the other
// (ring_support.hpp). Only points that nothing on their own ring supports are looked at, and what lies above and below
// them. O(n).
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <tilth/search/ring_layout.hpp>

namespace tilth {

/// What the tests of single points need, slot by slot.
struct Support {
  const RingLayout& rings;
  std::vector<float> distance;     // [m] from the sensor's axis
  std::vector<std::uint8_t> keep;  // by point
  float pair, line;                // [m] allowed between two distances; to the line through two others
  float slope;
  float reach;  // [rad] nearly: sine of the angle
};

/// The angle between two beams, nearly; 1 where they are one, or too far apart.
inline float angle_between(const Support& s, std::uint32_t a, std::uint32_t b) {
  const RingLayout& l = s.rings;
  const float sine = std::abs(l.ux[a] * l.uy[b] - l.uy[a] * l.ux[b]);
  const bool ahead = l.ux[a] * l.ux[b] + l.uy[a] * l.uy[b] > 0.0f;
  return ahead && sine < s.reach && l.index[a] != l.index[b] ? sine : 1.0f;
}

/// The slots that nothing on their own ring supports, ring by ring.
struct IsolatedPoints {
  std::vector<std::uint32_t> slots;
  std::vector<std::size_t> ring_begin{0};  ///< rings + 1: where each ring begins, and the end

  std::span<const std::uint32_t> ring(std::size_t r) const {
    return std::span(slots).subspan(ring_begin[r], ring_begin[r + 1] - ring_begin[r]);
  }
};

/// Keeps each two points on neighbouring rings, one of them isolated, that are seen in one direction at one distance.
void support_upright(Support& support, const IsolatedPoints& isolated);

}  // namespace tilth
