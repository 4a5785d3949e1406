// The neighbours of one point by looking at all others: where so many are equally near that no list of them is of use.
#if defined(TILTH_SEARCH_PLAIN_SEARCH_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TILTH_SEARCH_PLAIN_SEARCH_INL
#undef TILTH_SEARCH_PLAIN_SEARCH_INL
#else
#define TILTH_SEARCH_PLAIN_SEARCH_INL
#endif

#include <algorithm>

#include <hwy/highway.h>

#include <tilth/search/nearest_row.hpp>
#include <tilth/search/ring_layout.hpp>

HWY_BEFORE_NAMESPACE();
namespace tilth {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// Writes the row of the point in `slot`. O(n).
HWY_NOINLINE void search_plainly(const RingLayout& l, std::uint32_t slot, const Row& row) {
  constexpr std::uint32_t kLanes = HWY_LANES(float);
  const hn::ScalableTag<float> d;
  const auto x = hn::Set(d, l.x[slot]), y = hn::Set(d, l.y[slot]), z = hn::Set(d, l.z[slot]);
  NearestRow nearest(row.k);
  alignas(64) float distances[kLanes];
  for (const Ring& ring : l.rings) {
    for (std::uint32_t i = 0; i < ring.count; i += kLanes) {
      const std::uint32_t first = ring.begin + i, lanes = std::min(kLanes, ring.count - i);
      const auto dx = hn::Sub(hn::LoadU(d, &l.x[first]), x), dy = hn::Sub(hn::LoadU(d, &l.y[first]), y);
      const auto dz = hn::Sub(hn::LoadU(d, &l.z[first]), z);
      hn::Store(hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz)), d, distances);
      for (std::uint32_t j = 0; j < lanes; ++j) {
        if (first + j != slot && distances[j] <= nearest.limit()) nearest.insert(distances[j], l.index[first + j]);
      }
    }
  }
  nearest.write(row);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tilth
HWY_AFTER_NAMESPACE();
#endif
