// The neighbours of as many consecutive points of a ring as a vector has lanes. All lanes look at the same offsets from
// themselves, so candidates are plain loads: first along their own ring, then along the rings above and below as long
// as a lane's bound lets them hold anything nearer. Lanes that need much more than the others are finished alone.
#if defined(TILTH_SEARCH_BLOCK_SEARCH_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TILTH_SEARCH_BLOCK_SEARCH_INL
#undef TILTH_SEARCH_BLOCK_SEARCH_INL
#else
#define TILTH_SEARCH_BLOCK_SEARCH_INL
#endif

#include <algorithm>

#include <hwy/highway.h>

#include <tilth/search/direction_bound-inl.hpp>
#include <tilth/search/lone_search-inl.hpp>
#include <tilth/search/nearest_keys-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace tilth {
namespace HWY_NAMESPACE {
namespace {

template <std::size_t kKept>
class BlockSearch {
 public:
  BlockSearch(const RingLayout& layout, NeighborTable& table) : l_(layout), table_(table), lone_(layout, table) {}

  void enter_ring(std::uint32_t ring) { ring_ = ring; }

  /// Finds the neighbours of points i, i + 1, ... of the ring, as many as there are lanes.
  HWY_INLINE void search_block(std::uint32_t i) {
    const Ring& ring = l_.rings[ring_];
    const std::uint32_t slot = ring.begin + i;
    const std::uint32_t lanes = std::min(kLanes, ring.count - i);
    if (ring.count <= kKept) return search_alone(slot, lanes);
    Block b(l_, slot, lanes);
    search_own_ring(b);
    const float azimuth = l_.azimuth[slot + lanes / 2];
    const auto own = l_.rings.begin() + ring_;
    for (auto r = own + 1; r != l_.rings.end() && reaches(b, r->lowest_above, kZenith); ++r)
      search_ring(b, *r, azimuth);
    for (auto r = own; r != l_.rings.begin() && reaches(b, kNadir, (r - 1)->highest_below); --r)
      search_ring(b, *(r - 1), azimuth);
    write_rows(b, lanes);
  }

 private:
  using D = hn::ScalableTag<float>;
  using DI = hn::RebindToSigned<D>;
  using Floats = hn::Vec<D>;
  using Ints = hn::Vec<DI>;
  using Mask = hn::Mask<D>;
  static constexpr std::uint32_t kLanes = HWY_LANES(float);
  static constexpr std::uint32_t kMostCandidates = kNumberBits;  // one number less: no key equals a limit
  static constexpr std::uint32_t kPatience = kKept / 2 + 4;      // offsets after which a few lanes are left alone
  static constexpr std::uint32_t kReach = kKept / 2 + 24;        // offsets after which all are
  static constexpr std::size_t kFewLanes = kLanes / 4;
  static constexpr Elevation kZenith{1.0f, 0.0f}, kNadir{-1.0f, 0.0f};

  struct Block {
    Queries<D> queries;
    Ints keys[kKept];
    Mask active;              // lanes whose neighbours this block still finds
    Ints limit;               // a key above it is of no use to its lane; 0 where not active
    std::uint32_t slot;       // of the first lane
    std::uint32_t count = 0;  // candidates seen

    HWY_INLINE Block(const RingLayout& l, std::uint32_t s, std::uint32_t lanes)
        : queries(D(), l, s), active(hn::FirstN(D(), lanes)), slot(s) {}
  };

  HWY_INLINE Ints key_of(Block& b, std::uint32_t slot) {
    const Floats squared = squared_distance(D(), b.queries, l_, slot);
    hn::Store(squared, D(), distances_ + b.count * kLanes);
    slots_[b.count] = slot;
    const Ints upper = hn::And(hn::BitCast(DI(), squared), hn::Set(DI(), ~kNumberBits));
    return hn::Or(upper, hn::Set(DI(), std::int32_t(b.count++)));
  }

  HWY_INLINE void renew_limit(Block& b) {
    const Ints farthest = hn::Or(b.keys[kKept - 3], hn::Set(DI(), kNumberBits));
    b.limit = hn::IfThenElseZero(hn::RebindMask(DI(), b.active), farthest);
  }

  HWY_INLINE void add(Block& b, std::uint32_t slot) {
    const Ints key = key_of(b, slot);
    if (hn::AllFalse(DI(), hn::Lt(key, b.limit))) return;
    insert_key(b.keys, key);
    renew_limit(b);
  }

  // Lanes to which something beyond `bound` may still matter.
  HWY_INLINE Mask open_lanes(const Block& b, Floats bound) { return hn::Lt(bound, hn::BitCast(D(), b.limit)); }

  HWY_INLINE void leave(Block& b, Mask lanes) {
    b.active = hn::AndNot(lanes, b.active);
    renew_limit(b);
  }

  // True if the lanes in `open` are worth going on for after `seen` offsets; else they are left.
  HWY_INLINE bool go_on(Block& b, Mask open, std::uint32_t seen) {
    if (hn::AllFalse(D(), open)) return false;
    const bool few = seen > kPatience && hn::CountTrue(D(), open) <= kFewLanes;
    if (!few && seen < kReach && b.count < kMostCandidates) return true;
    leave(b, open);
    return false;
  }

  HWY_INLINE void search_own_ring(Block& b) {
    const std::uint32_t count = l_.rings[ring_].count;
    constexpr std::uint32_t kFirst = kKept / 2;
    const auto fill = [&]<std::size_t... i>(std::index_sequence<i...>) HWY_ATTR {
      ((b.keys[2 * i] = key_of(b, b.slot + i + 1), b.keys[2 * i + 1] = key_of(b, b.slot - i - 1)), ...);
    };
    fill(std::make_index_sequence<kFirst>());
    sort_keys(b.keys);
    renew_limit(b);
    expand(b, b.slot, kFirst, count, nullptr);
  }

  // Looks at the offsets beyond `seen` from `slot`, on each side until the bound closes it.
  HWY_INLINE void expand(Block& b, std::uint32_t slot, std::uint32_t seen, std::uint32_t count, const Ring* other) {
    std::uint32_t left = seen, right = seen;
    bool left_open = true, right_open = true;
    while ((left_open || right_open) && left + right + 1 < count) {
      if (right_open) {
        right_open = go_on(b, open_lanes(b, side_bound<1>(D(), b.queries, l_, slot + right + 1, other)), right);
        if (right_open) add(b, slot + ++right);
      }
      if (left_open && left + right + 1 < count) {
        left_open = go_on(b, open_lanes(b, side_bound<-1>(D(), b.queries, l_, slot - left - 1, other)), left);
        if (left_open) add(b, slot - ++left);
      }
    }
  }

  // True if a lane may have neighbours among elevations between `low` and `high`.
  HWY_INLINE bool reaches(const Block& b, const Elevation& low, const Elevation& high) {
    const Floats off = off_elevation(D(), b.queries, b.queries.rho, low, high);
    return !hn::AllFalse(D(), open_lanes(b, hn::Mul(off, off)));
  }

  HWY_INLINE void search_ring(Block& b, const Ring& ring, float azimuth) {
    if (!reaches(b, ring.low, ring.high)) return;
    const std::uint32_t slot = lone_.locate(ring, azimuth) - kLanes / 2;
    if (b.count == kMostCandidates) return leave(b, b.active);
    add(b, slot);
    expand(b, slot, 0, ring.count, &ring);
  }

  void search_alone(std::uint32_t slot, std::uint32_t lanes) {
    for (std::uint32_t i = 0; i < lanes; ++i) lone_.search(ring_, slot + i);
  }

  HWY_INLINE void write_rows(const Block& b, std::uint32_t lanes) {
    for (std::size_t j = 0; j < kKept; ++j) hn::Store(b.keys[j], DI(), keys_ + j * kLanes);
    std::uint8_t active[8] = {};
    hn::StoreMaskBits(D(), b.active, active);
    const std::uint32_t bits = active[0] | std::uint32_t(active[1]) << 8;
    for (std::uint32_t lane = 0; lane < lanes; ++lane) {
      if ((bits >> lane & 1) == 0 || !write_row(b.slot + lane, lane)) lone_.search(ring_, b.slot + lane);
    }
  }

  // False if keys alone cannot tell the k nearest.
  HWY_INLINE bool write_row(std::uint32_t slot, std::uint32_t lane) {
    const std::size_t k = table_.k;
    if ((keys_[(k - 1) * kLanes + lane] | kNumberBits) >= keys_[(kKept - 1) * kLanes + lane]) return false;
    Row row = lone_.row(slot);
    for (std::size_t j = 0; j < kKept; ++j) {
      const std::int32_t key = keys_[j * kLanes + lane];
      if (j >= k && key > (keys_[(k - 1) * kLanes + lane] | kNumberBits)) break;
      const std::uint32_t number = std::uint32_t(key & kNumberBits);
      row.insert(distances_[number * kLanes + lane], l_.index[slots_[number] + lane]);
    }
    return true;
  }

  const RingLayout& l_;
  NeighborTable& table_;
  LoneSearch lone_;
  std::uint32_t ring_ = 0;
  alignas(64) float distances_[kMostCandidates * kLanes];
  alignas(64) std::int32_t keys_[kKept * kLanes];
  std::uint32_t slots_[kMostCandidates];
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tilth
HWY_AFTER_NAMESPACE();
#endif
