// The neighbours of one point, its candidates taken a vector at a time: outwards from its azimuth on either side of its
// own ring, then of the rings above and below, until the bounds close them all.
#if defined(TILTH_SEARCH_ISOLATED_SEARCH_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TILTH_SEARCH_ISOLATED_SEARCH_INL
#undef TILTH_SEARCH_ISOLATED_SEARCH_INL
#else
#define TILTH_SEARCH_ISOLATED_SEARCH_INL
#endif

#include <algorithm>
#include <bit>
#include <limits>
#include <vector>

#include <hwy/highway.h>

#include <tilth/search/chunk_boxes-inl.hpp>
#include <tilth/search/direction_bound-inl.hpp>
#include <tilth/search/isolated_hits-inl.hpp>
#include <tilth/search/nearest_row.hpp>
#include <tilth/search/plain_search-inl.hpp>
#include <tilth/search/scan_kernel.hpp>

HWY_BEFORE_NAMESPACE();
namespace tilth {
namespace HWY_NAMESPACE {
namespace {

class IsolatedSearch {
 public:
  IsolatedSearch(const RingLayout& layout, SearchBuffers& buffers, NeighborTable& table)
      : l_(layout), table_(table), cursors_(buffers.cursors), boxes_(buffers.boxes) {
    cursors_.assign(layout.rings.size(), 0);
    boxes_.clear();
  }

  /// Where the table has the row of the point in `slot`.
  HWY_INLINE Row row(std::uint32_t slot) {
    const std::size_t begin = l_.index[slot] * table_.k;
    return {table_.squared_distances.data() + begin, table_.indices.data() + begin, table_.k};
  }

  /// The first slot of a ring whose azimuth is not below `azimuth`, up to the ring's end.
  HWY_INLINE std::uint32_t locate(const Ring& ring, float azimuth) {
    const float* const a = l_.azimuth.data() + ring.begin;
    while (azimuth < a[0]) azimuth += 4.0f;
    while (azimuth >= a[0] + 4.0f) azimuth -= 4.0f;
    std::uint32_t& i = cursors_[std::size_t(&ring - l_.rings.data())];
    while (i < ring.count && a[i] < azimuth) ++i;
    while (i > 0 && a[i - 1] >= azimuth) --i;
    return ring.begin + i;
  }

  /// Finds and writes the row of the point in `slot` of a ring, whose k nearest others are within the squared distance
  /// `limit`.
  HWY_NOINLINE void search(std::uint32_t ring, std::uint32_t slot, float limit) {
    const Isolated p = isolated_at(slot);
    hits_.begin(table_.k, limit);
    if (wide(p)) approach(p, ring);
    if (!complete(p, ring)) return search_plainly(l_, slot, row(slot));
    hits_.write(l_.index[slot], row(slot));
  }

 private:
  using D = hn::ScalableTag<float>;
  using Floats = hn::Vec<D>;
  using One = hn::CappedTag<float, 1>;
  static constexpr std::uint32_t kLanes = HWY_LANES(float);
  static constexpr float kWide = 0.03f;        // squared sine of the widest angle searched by direction
  static constexpr std::uint32_t kReach = 12;  // points on either side that an approach looks at
  static constexpr std::uint32_t kLeast = 64;  // points of a ring that is worth it

  struct Isolated {
    Queries<One> query;
    Floats x, y, z;
    float azimuth;
  };

  HWY_INLINE Isolated isolated_at(std::uint32_t slot) const {
    const D d;
    return {Queries<One>(One(), l_, slot), hn::Set(d, l_.x[slot]), hn::Set(d, l_.y[slot]), hn::Set(d, l_.z[slot]),
            l_.azimuth[slot]};
  }

  HWY_INLINE bool reaches(const Isolated& p, const Elevation& low, const Elevation& high) {
    const auto off = off_elevation(One(), p.query, p.query.rho, low, high);
    return hn::GetLane(hn::Mul(off, off)) <= hits_.limit();
  }

  template <int kSide>
  HWY_INLINE bool open(const Isolated& p, std::uint32_t slot, const Ring& ring) {
    return hn::GetLane(side_bound<kSide>(One(), p.query, l_, slot, &ring)) <= hits_.limit();
  }

  // Whether what is within the limit lies in so many directions that bounds by direction are of no use.
  HWY_INLINE bool wide(const Isolated& p) const { return !(hits_.limit() <= kWide * hn::GetLane(p.query.rho_squared)); }

  // Lowers the limit by what lies around the point in its ring and in two above and below.
  HWY_INLINE void approach(const Isolated& p, std::uint32_t ring) {
    for (const std::uint32_t r : {ring, ring + 1, ring - 1, ring + 2, ring - 2}) {
      if (r >= l_.rings.size() || l_.rings[r].count < kLeast) continue;
      const std::uint32_t reach = r == ring ? 2 * kReach : kReach;
      visit(p, locate(l_.rings[r], p.azimuth) - reach, 2 * reach);
    }
    hits_.thin();
    hits_.clear();
  }

  // Takes all that is within the limit.
  HWY_INLINE bool complete(const Isolated& p, std::uint32_t ring) {
    if (wide(p)) return search_boxes(p);
    const auto own = l_.rings.begin() + ring;
    if (!search_ring(p, *own)) return false;
    for (auto q = own + 1; q != l_.rings.end() && reaches(p, q->lowest_above, kZenith); ++q) {
      if (!search_ring(p, *q)) return false;
    }
    for (auto q = own; q != l_.rings.begin() && reaches(p, kNadir, (q - 1)->highest_below); --q) {
      if (!search_ring(p, *(q - 1))) return false;
    }
    return true;
  }

  HWY_INLINE Floats squared_to(const Isolated& p, std::uint32_t slot) const {
    const D d;
    const Floats dx = hn::Sub(hn::LoadU(d, &l_.x[slot]), p.x), dy = hn::Sub(hn::LoadU(d, &l_.y[slot]), p.y);
    const Floats dz = hn::Sub(hn::LoadU(d, &l_.z[slot]), p.z);
    return hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz));
  }

  // Takes what is near of `count` points from `slot` on. False if too many are equally near.
  HWY_INLINE bool visit(const Isolated& p, std::uint32_t slot, std::uint32_t count) {
    for (std::uint32_t i = 0; i < count; i += kLanes) {
      if (!hits_.take(squared_to(p, slot + i), &l_.index[slot + i], hn::FirstN(D(), count - i))) return false;
    }
    return true;
  }

  // Groups of boxes that the limit reaches, then the boxes of these, then their points.
  HWY_NOINLINE bool search_boxes(const Isolated& p) {
    if (boxes_.empty()) fill_boxes(boxes_, l_);
    const D d;
    const std::size_t groups = (boxes_.slots.size() + kLanes - 1) / kLanes;
    for (std::size_t i = 0; i < groups; i += kLanes) {
      const auto reached = hn::Le(box_distances(d, boxes_.groups, i, p), hn::Set(d, hits_.limit()));
      for (std::uint32_t bits = lane_bits(d, reached); bits != 0; bits &= bits - 1) {
        if (!visit_group(p, kLanes * (i + std::size_t(std::countr_zero(bits))))) return false;
      }
    }
    return true;
  }

  HWY_INLINE bool visit_group(const Isolated& p, std::size_t first) {
    const D d;
    const auto reached = hn::Le(box_distances(d, boxes_.runs, first, p), hn::Set(d, hits_.limit()));
    for (std::uint32_t bits = lane_bits(d, reached); bits != 0; bits &= bits - 1) {
      const std::size_t run = first + std::size_t(std::countr_zero(bits));
      if (!visit(p, boxes_.slots[run], boxes_.counts[run])) return false;
    }
    return true;
  }

  // Outwards from the point's azimuth on either side.
  HWY_NOINLINE bool search_ring(const Isolated& p, const Ring& ring) {
    if (!reaches(p, ring.low, ring.high)) return true;
    const std::uint32_t n = ring.count, middle = locate(ring, p.azimuth) - ring.begin;
    std::uint32_t right = 0, left = 0;  // points seen on either side of the middle
    bool right_open = true, left_open = true;
    while ((right_open || left_open) && right + left < n) {
      const std::uint32_t ahead = ring.begin + (middle + right) % n;
      right_open = right_open && open<1>(p, ahead, ring);
      if (right_open) {
        const std::uint32_t count = std::min(kLanes, n - right - left);
        if (!visit(p, ahead, count)) return false;
        right += count;
      }
      const std::uint32_t behind = ring.begin + (middle + n - left - 1) % n;
      left_open = left_open && right + left < n && open<-1>(p, behind, ring);
      if (left_open) {
        const std::uint32_t count = std::min(kLanes, n - right - left);
        if (!visit(p, behind + 1 - count, count)) return false;
        left += count;
      }
    }
    return true;
  }

  const RingLayout& l_;
  NeighborTable& table_;
  std::vector<std::uint32_t>& cursors_;
  ChunkBoxes& boxes_;
  IsolatedHits hits_;
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tilth
HWY_AFTER_NAMESPACE();
#endif
