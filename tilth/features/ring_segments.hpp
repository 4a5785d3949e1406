// Every ring of a scan cut into short runs of neighbouring points, with their moments: at a step in depth, and where a
// run has its length. O(n).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <tilth/core/options.hpp>
#include <tilth/core/point_cloud.hpp>
#include <tilth/features/moments.hpp>
#include <tilth/search/ring_layout.hpp>

namespace tilth {

struct SegmentOptions {
  double length = 0.25;
  double min_jump = 0.15;
  double jump_ratio = 0.03;
  int min_points = 3;
};

template <class V>
void visit(SegmentOptions& o, V&& v) {
  v("length", o.length, Bounds{0.01, 10}, "[m] of a run of points of one beam, which make one patch; at least 4 steps");
  v("min_jump", o.min_jump, Bounds{0.001, 10}, "[m] step in range that ends a run, at least");
  v("jump_ratio", o.jump_ratio, Bounds{0, 1}, "[-] step in range that ends a run, as a share of the range, at least");
  v("min_points", o.min_points, Bounds{2, 1000}, "[points] fewer are no patch");
}

struct RingSegment {
  Moments moments;
  float azimuth = 0.0f;  ///< [rad] of its mean, 0 .. 2 pi
  float width = 0.0f;    ///< [rad] nearly
  float time = 0.0f;     ///< [s] mean of its points; 0 where they have none
  bool free = false;     ///< ends at a step in depth on both sides
};

/// The segments of all rings, one ring after another.
struct RingSegments {
  std::vector<RingSegment> segments;      ///< of each ring ascending in azimuth from the x axis on
  std::vector<std::uint32_t> ring_begin;  ///< where each ring that has points begins, upwards, and the end

  std::size_t rings() const { return ring_begin.empty() ? 0 : ring_begin.size() - 1; }
  std::span<const RingSegment> ring(std::size_t r) const {
    return std::span(segments).subspan(ring_begin[r], ring_begin[r + 1] - ring_begin[r]);
  }
};

/// `rings` is the layout of `cloud`. Points whose entry in `keep`, one a point, is zero are passed over.
RingSegments ring_segments(const PointCloud& cloud, const RingLayout& rings, std::span<const std::uint8_t> keep,
                           const SegmentOptions& options);

}  // namespace tilth
