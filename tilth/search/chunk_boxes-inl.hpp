// Boxes around short runs of every ring, tested a vector at a time: for the few points, mostly near the sensor and far
// from everything, whose neighbours lie in so many directions that bounds by direction are of no use.
#if defined(TILTH_SEARCH_CHUNK_BOXES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TILTH_SEARCH_CHUNK_BOXES_INL
#undef TILTH_SEARCH_CHUNK_BOXES_INL
#else
#define TILTH_SEARCH_CHUNK_BOXES_INL
#endif

#include <algorithm>
#include <limits>

#include <hwy/highway.h>

#include <tilth/search/ring_layout.hpp>

HWY_BEFORE_NAMESPACE();
namespace tilth {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::uint32_t kChunk = 32;  // slots of a box

inline void span_of(const float* values, std::uint32_t count, std::vector<float>& low, std::vector<float>& high) {
  const hn::ScalableTag<float> d;
  auto least = hn::Set(d, values[0]), most = least;
  for (std::uint32_t i = 0; i < count; i += HWY_LANES(float)) {
    const auto some = hn::IfThenElse(hn::FirstN(d, count - i), hn::LoadU(d, values + i), least);
    least = hn::Min(least, some);
    most = hn::Max(most, some);
  }
  low.push_back(hn::GetLane(hn::MinOfLanes(d, least)));
  high.push_back(hn::GetLane(hn::MaxOfLanes(d, most)));
}

inline void box_of(ChunkBoxes& boxes, const RingLayout& l, std::uint32_t slot, std::uint32_t count) {
  span_of(&l.x[slot], count, boxes.runs.low_x, boxes.runs.high_x);
  span_of(&l.y[slot], count, boxes.runs.low_y, boxes.runs.high_y);
  span_of(&l.z[slot], count, boxes.runs.low_z, boxes.runs.high_z);
  boxes.slots.push_back(slot);
  boxes.counts.push_back(count);
}

// A vector of boxes is a group.
inline void fill_groups(const std::vector<float>& runs, std::size_t count, bool low, std::vector<float>& groups) {
  const hn::ScalableTag<float> d;
  for (std::size_t i = 0; i < count; i += HWY_LANES(float)) {
    const auto some = hn::IfThenElse(hn::FirstN(d, count - i), hn::LoadU(d, &runs[i]), hn::Set(d, runs[i]));
    groups.push_back(hn::GetLane(low ? hn::MinOfLanes(d, some) : hn::MaxOfLanes(d, some)));
  }
}

inline void end_with_far(Boxes& b) {
  for (auto* bounds : {&b.low_x, &b.high_x, &b.low_y, &b.high_y, &b.low_z, &b.high_z}) {
    bounds->resize(bounds->size() + HWY_LANES(float), std::numeric_limits<float>::infinity());
  }
}

/// Boxes of all rings, sector by sector, and far away ones to fill the last vector.
inline void fill_boxes(ChunkBoxes& boxes, const RingLayout& l) {
  std::uint32_t longest = 0;
  for (const Ring& ring : l.rings) longest = std::max(longest, ring.count);
  for (std::uint32_t i = 0; i < longest; i += kChunk) {
    for (const Ring& ring : l.rings) {
      if (i < ring.count) box_of(boxes, l, ring.begin + i, std::min(kChunk, ring.count - i));
    }
  }
  end_with_far(boxes.runs);
  const std::size_t count = boxes.slots.size();
  fill_groups(boxes.runs.low_x, count, true, boxes.groups.low_x);
  fill_groups(boxes.runs.high_x, count, false, boxes.groups.high_x);
  fill_groups(boxes.runs.low_y, count, true, boxes.groups.low_y);
  fill_groups(boxes.runs.high_y, count, false, boxes.groups.high_y);
  fill_groups(boxes.runs.low_z, count, true, boxes.groups.low_z);
  fill_groups(boxes.runs.high_z, count, false, boxes.groups.high_z);
  end_with_far(boxes.groups);
  boxes.distances.resize(boxes.groups.low_x.size());
}

template <class V>
HWY_INLINE V outside(V p, V low, V high) {
  return hn::Max(hn::Max(hn::Sub(low, p), hn::Sub(p, high)), hn::Sub(p, p));
}

/// Squared distances, rounded as those of points are, to the boxes from number `i` on from p, whose x, y and z hold its
/// coordinate in the first lane.
template <class D, class Point>
HWY_INLINE hn::Vec<D> box_distances(D d, const Boxes& b, std::size_t i, const Point& p) {
  const auto dx = outside(hn::Set(d, hn::GetLane(p.x)), hn::LoadU(d, &b.low_x[i]), hn::LoadU(d, &b.high_x[i]));
  const auto dy = outside(hn::Set(d, hn::GetLane(p.y)), hn::LoadU(d, &b.low_y[i]), hn::LoadU(d, &b.high_y[i]));
  const auto dz = outside(hn::Set(d, hn::GetLane(p.z)), hn::LoadU(d, &b.low_z[i]), hn::LoadU(d, &b.high_z[i]));
  return hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz));
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tilth
HWY_AFTER_NAMESPACE();
#endif
