// The nearest candidates of each lane, sorted by a network of minima and maxima (Batcher's merge exchange, Knuth TAOCP
// 3, 5.2.2 M, then insertion). A key is the squared distance with its low bits given to the candidate's number: one
// integer carries both. Where equal upper bits leave the order open, the exact distances decide later.
#if defined(TILTH_SEARCH_NEAREST_KEYS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TILTH_SEARCH_NEAREST_KEYS_INL
#undef TILTH_SEARCH_NEAREST_KEYS_INL
#else
#define TILTH_SEARCH_NEAREST_KEYS_INL
#endif

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <hwy/highway.h>

#include <tilth/search/compress-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace tilth {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::int32_t kNumberBits = 0xFF;
constexpr std::int32_t kNoKey = 0x7F7FFFFF;  // a distance that nothing has

struct Comparator {
  std::uint8_t low, high;
};

/// Calls visit(low, high) for each comparator of the network that sorts n keys.
template <class Visit>
constexpr void merge_exchange(std::size_t n, const Visit& visit) {
  std::size_t top = 1;
  while (2 * top < n) top *= 2;
  for (std::size_t p = top; p > 0; p /= 2) {
    std::size_t r = 0, step = p;
    for (std::size_t q = top;; q /= 2) {
      for (std::size_t i = 0; i + step < n; ++i) {
        if ((i & p) == r) visit(i, i + step);
      }
      if (q == p) break;
      step = q - p;
      r = p;
    }
  }
}

template <std::size_t kCount>
constexpr std::size_t network_size() {
  std::size_t size = 0;
  merge_exchange(kCount, [&](std::size_t, std::size_t) { ++size; });
  return size;
}

template <std::size_t kCount>
constexpr auto sorting_network() {
  std::array<Comparator, network_size<kCount>()> network{};
  std::size_t size = 0;
  merge_exchange(kCount, [&](std::size_t a, std::size_t b) { network[size++] = {std::uint8_t(a), std::uint8_t(b)}; });
  return network;
}

template <class V>
HWY_INLINE void exchange(V& low, V& high) {
  const V least = hn::Min(low, high);
  high = hn::Max(low, high);
  low = least;
}

template <class V, std::size_t kCount, std::size_t... i>
HWY_INLINE void run_network(V (&keys)[kCount], std::index_sequence<i...>) {
  constexpr auto kNetwork = sorting_network<kCount>();
  (exchange(keys[kNetwork[i].low], keys[kNetwork[i].high]), ...);
}

/// Sorts each lane of `keys`, ascending.
template <class V, std::size_t kCount>
HWY_INLINE void sort_keys(V (&keys)[kCount]) {
  run_network(keys, std::make_index_sequence<network_size<kCount>()>());
}

/// Keeps the least of `keys` and one more key, sorted. From the far end, so that most of a long list is left alone.
template <class DI, std::size_t kCount>
HWY_INLINE void insert_key(DI d, hn::Vec<DI> (&keys)[kCount], hn::Vec<DI> key) {
  constexpr std::size_t kStep = 12;
  std::size_t j = kCount - 1;
  for (; j >= kStep; --j) {
    keys[j] = hn::Max(keys[j - 1], hn::Min(keys[j], key));
    if (j % kStep == 0 && hn::AllFalse(d, hn::Lt(key, keys[j - 1]))) return;
  }
  HWY_UNROLL(12) for (j = std::min(kCount, kStep) - 1; j > 0; --j) {
    keys[j] = hn::Max(keys[j - 1], hn::Min(keys[j], key));
  }
  keys[0] = hn::Min(keys[0], key);
}

/// A bit for each lane in which two keys that follow one another among the first kSorted differ in their number only.
template <std::size_t kSorted, class DI, std::size_t kCount>
HWY_INLINE std::uint32_t lanes_with_ties(DI d, const hn::Vec<DI> (&keys)[kCount]) {
  auto least = hn::Set(d, kNoKey);
  HWY_UNROLL(64) for (std::size_t j = 1; j < kSorted; ++j) least = hn::Min(least, hn::Xor(keys[j], keys[j - 1]));
  return lane_bits(d, hn::Lt(least, hn::Set(d, kNumberBits + 1)));
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tilth
HWY_AFTER_NAMESPACE();
#endif
