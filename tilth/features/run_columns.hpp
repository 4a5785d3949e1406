// The runs of a scan's rings by what lies above and below them. O(runs).
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include <tilth/features/ring_segments.hpp>

namespace tilth {

/// A run between those beside it: two rings down, one down, itself, one up, two up; nullptr where there is none.
using Column = std::array<const RingSegment*, 5>;
inline constexpr std::size_t kSelf = 2, kBelow = 1, kAbove = 3;

inline std::vector<float> azimuths_of(const RingSegments& rings) {
  std::vector<float> azimuths;
  azimuths.reserve(rings.segments.size());
  for (const RingSegment& segment : rings.segments) azimuths.push_back(segment.azimuth);
  return azimuths;
}

/// The columns of the runs of one ring, one after another.
class ColumnWalk {
 public:
  /// `azimuths` are those of all runs of `rings`.
  ColumnWalk(const RingSegments& rings, std::span<const float> azimuths, std::size_t ring)
      : rings_(rings), azimuths_(azimuths), ring_(ring) {
    for (std::size_t i = 0; i < cursors_.size(); ++i) cursors_[i] = has(i) ? rings.ring_begin[number_of(i)] : 0;
  }

  Column at(const RingSegment& segment) {
    constexpr float kBeside = 0.03f;  // [rad]
    Column column{};
    column[kSelf] = &segment;
    for (std::size_t i = 0; i < column.size(); ++i) {
      if (i == kSelf || !has(i) || rings_.ring(number_of(i)).empty()) continue;
      const std::size_t other = nearest(i, segment.azimuth);
      if (std::abs(azimuths_[other] - segment.azimuth) < kBeside + segment.width) column[i] = &rings_.segments[other];
    }
    return column;
  }

 private:
  bool has(std::size_t i) const { return ring_ + i >= kSelf && ring_ + i - kSelf < rings_.rings(); }
  std::size_t number_of(std::size_t i) const { return ring_ + i - kSelf; }

  // The run of the i-th ring nearest in azimuth, for azimuths that ascend from call to call.
  std::size_t nearest(std::size_t i, float azimuth) {
    const std::size_t end = rings_.ring_begin[number_of(i) + 1];
    const auto distance = [&](std::size_t run) { return std::abs(azimuths_[run] - azimuth); };
    std::size_t& cursor = cursors_[i];
    while (cursor + 1 < end && distance(cursor + 1) <= distance(cursor)) ++cursor;
    return cursor;
  }

  const RingSegments& rings_;
  std::span<const float> azimuths_;
  std::size_t ring_;
  std::array<std::size_t, 5> cursors_;
};

}  // namespace tilth
