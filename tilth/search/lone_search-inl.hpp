// The neighbours of one point, its candidates taken a vector at a time: outwards from its azimuth on either side of its
// own ring, then of the rings above and below, until the bounds close them all.
#if defined(TILTH_SEARCH_LONE_SEARCH_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TILTH_SEARCH_LONE_SEARCH_INL
#undef TILTH_SEARCH_LONE_SEARCH_INL
#else
#define TILTH_SEARCH_LONE_SEARCH_INL
#endif

#include <algorithm>
#include <limits>
#include <vector>

#include <hwy/highway.h>

#include <tilth/search/direction_bound-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace tilth {
namespace HWY_NAMESPACE {
namespace {

/// A row of the table while it is filled: the nearest so far, by distance, then by index.
struct Row {
  float* distances;
  std::uint32_t* indices;
  std::size_t k;
  std::size_t count = 0;

  HWY_INLINE float limit() const { return count == k ? distances[k - 1] : std::numeric_limits<float>::infinity(); }

  HWY_INLINE void insert(float distance, std::uint32_t index) {
    const auto before = [&](std::size_t j) {
      return distances[j] < distance || (distances[j] == distance && indices[j] < index);
    };
    if (count == k && before(k - 1)) return;
    std::size_t j = count < k ? count++ : k - 1;
    for (; j > 0 && !before(j - 1); --j) {
      distances[j] = distances[j - 1];
      indices[j] = indices[j - 1];
    }
    distances[j] = distance;
    indices[j] = index;
  }
};

class LoneSearch {
 public:
  LoneSearch(const RingLayout& layout, NeighborTable& table)
      : l_(layout), table_(table), cursors_(layout.rings.size(), 0) {}

  /// The row of the point in `slot`, empty.
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

  /// Fills the row of the point in `slot` of a ring.
  void search(std::uint32_t ring, std::uint32_t slot) {
    Lone p{Queries<One>(One(), l_, slot), row(slot), l_.index[slot], l_.azimuth[slot]};
    const auto own = l_.rings.begin() + ring;
    search_ring(p, *own);
    for (auto r = own + 1; r != l_.rings.end() && reaches(p, r->lowest_above, kZenith); ++r) search_ring(p, *r);
    for (auto r = own; r != l_.rings.begin() && reaches(p, kNadir, (r - 1)->highest_below); --r)
      search_ring(p, *(r - 1));
  }

 private:
  using D = hn::ScalableTag<float>;
  using One = hn::CappedTag<float, 1>;
  static constexpr std::uint32_t kLanes = HWY_LANES(float);
  static constexpr Elevation kZenith{1.0f, 0.0f}, kNadir{-1.0f, 0.0f};

  struct Lone {
    Queries<One> query;
    Row row;
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
    if (hn::AllFalse(d, hn::Le(squared, hn::Set(d, p.row.limit())))) return;
    alignas(64) float distances[kLanes];
    hn::Store(squared, d, distances);
    for (std::uint32_t i = 0; i < count; ++i) {
      if (distances[i] <= p.row.limit() && l_.index[slot + i] != p.self) p.row.insert(distances[i], l_.index[slot + i]);
    }
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
  std::vector<std::uint32_t> cursors_;
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tilth
HWY_AFTER_NAMESPACE();
#endif
