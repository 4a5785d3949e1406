// The neighbours of one point, its candidates taken a vector at a time: outwards from its azimuth on either side of its
// own ring, then of the rings above and below, until the bounds close them all.
#if defined(TILTH_SEARCH_LONE_SEARCH_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TILTH_SEARCH_LONE_SEARCH_INL
#undef TILTH_SEARCH_LONE_SEARCH_INL
#else
#define TILTH_SEARCH_LONE_SEARCH_INL
#endif

#include <algorithm>
#include <bit>
#include <limits>
#include <vector>

#include <hwy/highway.h>

#include <tilth/search/chunk_boxes-inl.hpp>
#include <tilth/search/direction_bound-inl.hpp>
#include <tilth/search/nearest_keys-inl.hpp>
#include <tilth/search/nearest_row.hpp>
#include <tilth/search/scan_kernel.hpp>

HWY_BEFORE_NAMESPACE();
namespace tilth {
namespace HWY_NAMESPACE {
namespace {

class LoneSearch {
 public:
  LoneSearch(const RingLayout& layout, SearchBuffers& buffers, NeighborTable& table)
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

  /// Completes `nearest` of the point in `slot` of a ring, which may hold some of its neighbours already.
  void search(std::uint32_t ring, std::uint32_t slot, NearestRow& nearest) {
    Lone p{Queries<One>(One(), l_, slot), nearest, l_.index[slot], l_.azimuth[slot]};
    if (nearest.limit() > kWide * hn::GetLane(p.query.rho_squared))
      return search_boxes(p, (slot - l_.rings[ring].begin) / kChunk * l_.rings.size() / kLanes);
    const auto own = l_.rings.begin() + ring;
    search_ring(p, *own);
    for (auto q = own + 1; q != l_.rings.end() && reaches(p, q->lowest_above, kZenith); ++q) search_ring(p, *q);
    for (auto q = own; q != l_.rings.begin() && reaches(p, kNadir, (q - 1)->highest_below); --q)
      search_ring(p, *(q - 1));
  }

 private:
  using D = hn::ScalableTag<float>;
  using One = hn::CappedTag<float, 1>;
  static constexpr std::uint32_t kLanes = HWY_LANES(float);
  static constexpr float kWide = 0.03f;  // squared sine of the widest angle searched by direction

  struct Lone {
    Queries<One> query;
    NearestRow& row;
    std::uint32_t self;
    float azimuth;
  };

  HWY_INLINE bool reaches(const Lone& p, const Elevation& low, const Elevation& high) {
    const auto off = off_elevation(One(), p.query, p.query.rho, low, high);
    return hn::GetLane(hn::Mul(off, off)) < p.row.limit();
  }

  template <int kSide>
  HWY_INLINE bool open(const Lone& p, std::uint32_t slot, const Ring& ring) {
    return hn::GetLane(side_bound<kSide>(One(), p.query, l_, slot, &ring)) < p.row.limit();
  }

  // Offers the first `count` points from `slot` on to the row.
  HWY_INLINE void visit(Lone& p, std::uint32_t slot, std::uint32_t count) {
    const D d;
    const auto dx = hn::Sub(hn::LoadU(d, &l_.x[slot]), hn::Set(d, hn::GetLane(p.query.x)));
    const auto dy = hn::Sub(hn::LoadU(d, &l_.y[slot]), hn::Set(d, hn::GetLane(p.query.y)));
    const auto dz = hn::Sub(hn::LoadU(d, &l_.z[slot]), hn::Set(d, hn::GetLane(p.query.z)));
    const auto squared = hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz));
    const auto near = hn::And(hn::Le(squared, hn::Set(d, p.row.limit())), hn::FirstN(d, count));
    if (hn::AllFalse(d, near)) return;
    alignas(64) float distances[kLanes];
    hn::Store(squared, d, distances);
    for (std::uint32_t bits = lane_bits(d, near); bits != 0; bits &= bits - 1) {
      const std::uint32_t i = std::uint32_t(std::countr_zero(bits)), index = l_.index[slot + i];
      if (index != p.self) p.row.insert(distances[i], index);
    }
  }

  // From the vector of boxes in the point's sector on to both sides.
  void search_boxes(Lone& p, std::size_t first) {
    if (boxes_.empty()) fill_boxes(boxes_, l_);
    const std::size_t vectors = (boxes_.slots.size() + kLanes - 1) / kLanes;
    first = std::min(first, vectors - 1);
    std::size_t right = first, left = first;
    while (right < vectors || left > 0) {
      if (right < vectors) visit_boxes(p, kLanes * right++);
      if (left > 0) visit_boxes(p, kLanes * --left);
    }
  }

  HWY_INLINE void visit_boxes(Lone& p, std::size_t i) {
    const D d;
    const auto squared = box_distances(d, boxes_, i, p.query);
    const std::uint32_t near = lane_bits(d, hn::Le(squared, hn::Set(d, p.row.limit())));
    if (near == 0) return;
    alignas(64) float distances[kLanes];
    hn::Store(squared, d, distances);
    for (std::uint32_t bits = near; bits != 0; bits &= bits - 1) {
      const std::size_t j = std::size_t(std::countr_zero(bits));
      if (distances[j] <= p.row.limit()) visit_run(p, boxes_.slots[i + j], boxes_.counts[i + j]);
    }
  }

  HWY_INLINE void visit_run(Lone& p, std::uint32_t slot, std::uint32_t count) {
    for (std::uint32_t i = 0; i < count; i += kLanes) visit(p, slot + i, std::min(kLanes, count - i));
  }

  void search_ring(Lone& p, const Ring& ring) {
    if (!reaches(p, ring.low, ring.high)) return;
    const std::uint32_t n = ring.count, middle = locate(ring, p.azimuth) - ring.begin;
    std::uint32_t right = 0, left = 0;  // points seen on either side of the middle
    bool right_open = true, left_open = true;
    while ((right_open || left_open) && right + left < n) {
      const std::uint32_t ahead = ring.begin + (middle + right) % n;
      right_open = right_open && open<1>(p, ahead, ring);
      if (right_open) {
        const std::uint32_t count = std::min(kLanes, n - right - left);
        visit(p, ahead, count);
        right += count;
      }
      const std::uint32_t behind = ring.begin + (middle + n - left - 1) % n;
      left_open = left_open && right + left < n && open<-1>(p, behind, ring);
      if (left_open) {
        const std::uint32_t count = std::min(kLanes, n - right - left);
        visit(p, behind + 1 - count, count);
        left += count;
      }
    }
  }

  const RingLayout& l_;
  NeighborTable& table_;
  std::vector<std::uint32_t>& cursors_;
  ChunkBoxes& boxes_;
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tilth
HWY_AFTER_NAMESPACE();
#endif
