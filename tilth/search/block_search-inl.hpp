// The neighbours of as many consecutive points of a ring as a vector has lanes. All lanes look at the same offsets, so
// candidates are plain loads: along their own ring, then along those above and below while a lane's bound lets them
// hold anything nearer. Lanes that need much more than the others are finished alone.
#if defined(TILTH_SEARCH_BLOCK_SEARCH_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TILTH_SEARCH_BLOCK_SEARCH_INL
#undef TILTH_SEARCH_BLOCK_SEARCH_INL
#else
#define TILTH_SEARCH_BLOCK_SEARCH_INL
#endif

#include <algorithm>
#include <limits>
#include <utility>

#include <hwy/highway.h>

#include <tilth/search/candidate_rows-inl.hpp>
#include <tilth/search/direction_bound-inl.hpp>
#include <tilth/search/isolated_search-inl.hpp>
#include <tilth/search/nearest_keys-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace tilth {
namespace HWY_NAMESPACE {
namespace {

template <std::size_t kKept>
class BlockSearch {
 public:
  BlockSearch(const RingLayout& layout, SearchBuffers& buffers, NeighborTable& table)
      : l_(layout), table_(table), isolated_(layout, buffers, table) {}

  /// Finds the neighbours of points i, i + 1, ... of a ring, as many as there are lanes.
  HWY_INLINE void search_block(std::uint32_t r, std::uint32_t i) {
    ring_ = r;
    const Ring& ring = l_.rings[r];
    const std::uint32_t slot = ring.begin + i;
    const std::uint32_t lanes = std::min(kLanes, ring.count - i);
    if (ring.count <= kKept) return search_alone(slot, lanes);
    Block b(l_, slot, lanes);
    search_own_ring(b);
    const float azimuth = l_.azimuth[slot + lanes / 2];
    const auto own = l_.rings.begin() + ring_;
    for (auto q = own + 1; q != l_.rings.end() && reaches(b, q->lowest_above, kZenith); ++q) {
      search_ring(b, *q, azimuth);
    }
    for (auto q = own; q != l_.rings.begin() && reaches(b, kNadir, (q - 1)->highest_below); --q) {
      search_ring(b, *(q - 1), azimuth);
    }
    write_rows(b, lanes);
  }

 private:
  using D = hn::ScalableTag<float>;
  using DI = hn::RebindToSigned<D>;
  using Floats = hn::Vec<D>;
  using Ints = hn::Vec<DI>;
  using Mask = hn::Mask<D>;
  using Rows = CandidateRows<kKept>;
  static constexpr std::uint32_t kLanes = HWY_LANES(float);
  static constexpr std::uint32_t kPatience = kKept / 2 + 24;      // offsets after which one lane in eight is left
  static constexpr std::uint32_t kReach = RingLayout::kPad - 24;  // offsets after which all are

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
    rows_.set(b.count, squared, &l_.index[slot]);
    const Ints upper = hn::And(hn::BitCast(DI(), squared), hn::Set(DI(), ~kNumberBits));
    return hn::Or(upper, hn::Set(DI(), std::int32_t(b.count++)));
  }

  HWY_INLINE void renew_limit(Block& b) {
    const Ints farthest = hn::Or(b.keys[Rows::kWanted - 1], hn::Set(DI(), kNumberBits));
    b.limit = hn::IfThenElseZero(hn::RebindMask(DI(), b.active), farthest);
  }

  HWY_INLINE void add(Block& b, std::uint32_t slot) {
    const Ints key = key_of(b, slot);
    if (hn::AllFalse(DI(), hn::Lt(key, b.limit))) return;
    insert_key(DI(), b.keys, key);
    renew_limit(b);
  }

  HWY_INLINE void add_two(Block& b, std::uint32_t first, std::uint32_t second) {
    const Ints key1 = key_of(b, first), key2 = key_of(b, second);
    if (hn::AllFalse(DI(), hn::Lt(hn::Min(key1, key2), b.limit))) return;
    insert_key(DI(), b.keys, key1);
    insert_key(DI(), b.keys, key2);
    renew_limit(b);
  }

  HWY_INLINE Mask open_lanes(const Block& b, Floats bound) { return hn::Lt(bound, hn::BitCast(D(), b.limit)); }

  HWY_INLINE void leave(Block& b, Mask lanes) {
    b.active = hn::AndNot(lanes, b.active);
    renew_limit(b);
  }

  // True if the lanes in `open` are worth going on for after `seen` offsets; else they are left.
  HWY_INLINE bool go_on(Block& b, Mask open, std::uint32_t seen) {
    if (hn::AllFalse(D(), open)) return false;
    const bool few = seen > kPatience && hn::CountTrue(D(), open) <= kLanes / 8;
    if (!few && seen < kReach && b.count + 3 < Rows::kMostCandidates) return true;
    leave(b, open);
    return false;
  }

  template <std::size_t... i>
  HWY_INLINE void fill_keys(Block& b, std::index_sequence<i...>) {
    ((b.keys[2 * i] = key_of(b, b.slot + i + 1), b.keys[2 * i + 1] = key_of(b, b.slot - i - 1)), ...);
  }

  HWY_INLINE void search_own_ring(Block& b) {
    constexpr std::uint32_t kFirst = kKept / 2;
    fill_keys(b, std::make_index_sequence<kFirst>());
    sort_keys(b.keys);
    renew_limit(b);
    expand(b, b.slot, kFirst, l_.rings[ring_].count, nullptr);
  }

  // Looks at the offsets beyond `seen` from `slot`, on each side until the bound closes it.
  HWY_NOINLINE void expand(Block& b, std::uint32_t slot, std::uint32_t seen, std::uint32_t count, const Ring* other) {
    std::uint32_t left = seen, right = seen;
    bool left_open = true, right_open = true;
    while ((left_open || right_open) && left + right + 2 < count) {
      right_open =
          right_open && go_on(b, open_lanes(b, side_bound<1>(D(), b.queries, l_, slot + right + 1, other)), right);
      if (right_open) add_two(b, slot + right + 1, slot + right + 2), right += 2;
      if (left + right + 2 >= count) break;
      left_open =
          left_open && go_on(b, open_lanes(b, side_bound<-1>(D(), b.queries, l_, slot - left - 1, other)), left);
      if (left_open) add_two(b, slot - left - 1, slot - left - 2), left += 2;
    }
    if ((left_open || right_open) && left + right + 2 == count) add(b, slot + right + 1);
  }

  HWY_INLINE bool reaches(const Block& b, const Elevation& low, const Elevation& high) {
    const Floats off = off_elevation(D(), b.queries, b.queries.rho, low, high);
    return !hn::AllFalse(D(), open_lanes(b, hn::Mul(off, off)));
  }

  HWY_INLINE void search_ring(Block& b, const Ring& ring, float azimuth) {
    if (!reaches(b, ring.low, ring.high)) return;
    const std::uint32_t slot = isolated_.locate(ring, azimuth) - kLanes / 2;
    if (b.count + 3 >= Rows::kMostCandidates) return leave(b, b.active);
    add(b, slot);
    expand(b, slot, 0, ring.count, &ring);
  }

  void search_alone(std::uint32_t slot, std::uint32_t lanes) {
    constexpr float kAnything = std::numeric_limits<float>::max();
    for (std::uint32_t i = 0; i < lanes; ++i) isolated_.search(ring_, slot + i, kAnything);
  }

  // Rows that the keys do not tell: of left lanes, some of whose neighbours are known, and those with ties.
  HWY_NOINLINE void settle(std::uint32_t slot, std::uint32_t lane, bool active) {
    NearestRow nearest(table_.k);
    if (active) rows_.offer(lane, nearest);
    if (!active || !rows_.offer_ties(lane, nearest)) return isolated_.search(ring_, slot, rows_.limit(lane, table_.k));
    nearest.write(isolated_.row(slot));
  }

  HWY_INLINE void write_rows(const Block& b, std::uint32_t lanes) {
    rows_.set_keys(b.keys);
    const std::uint32_t active = lane_bits(D(), b.active);
    const std::uint32_t clear = active & ~lanes_with_ties<Rows::kWanted + 1>(DI(), b.keys);
    for (std::uint32_t lane = 0; lane < lanes; ++lane) {
      if ((clear >> lane & 1) != 0) {
        rows_.write(lane, isolated_.row(b.slot + lane));
      } else {
        settle(b.slot + lane, lane, (active >> lane & 1) != 0);
      }
    }
  }

  const RingLayout& l_;
  const NeighborTable& table_;
  IsolatedSearch isolated_;
  std::uint32_t ring_ = 0;
  Rows rows_;
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tilth
HWY_AFTER_NAMESPACE();
#endif
