// What a block has seen, and how rows of the table are read from its sorted keys.
#if defined(TILTH_SEARCH_CANDIDATE_ROWS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TILTH_SEARCH_CANDIDATE_ROWS_INL
#undef TILTH_SEARCH_CANDIDATE_ROWS_INL
#else
#define TILTH_SEARCH_CANDIDATE_ROWS_INL
#endif

#include <hwy/highway.h>

#include <tilth/search/lone_search-inl.hpp>
#include <tilth/search/nearest_keys-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace tilth {
namespace HWY_NAMESPACE {
namespace {

template <std::size_t kKept>
struct CandidateRows {
  static constexpr std::uint32_t kLanes = HWY_LANES(float);
  static constexpr std::uint32_t kMostCandidates = kNumberBits - 2;  // no key equals a limit

  alignas(64) float distances[kMostCandidates * kLanes];  // squared, of each candidate from each lane
  alignas(64) std::int32_t keys[kKept * kLanes];
  std::uint32_t slots[kMostCandidates];  // of each candidate, seen from the first lane

  HWY_INLINE void write(const RingLayout& l, std::uint32_t lane, const Row& row) const {
    float* HWY_RESTRICT const row_distances = row.distances;
    std::uint32_t* HWY_RESTRICT const row_indices = row.indices;
    const std::int32_t* HWY_RESTRICT const key = keys + lane;
    const float* HWY_RESTRICT const distance = distances + lane;
    const std::uint32_t* HWY_RESTRICT const index = l.index.data() + lane;
    for (std::size_t j = 0; j < row.k; ++j) {
      const std::uint32_t number = std::uint32_t(key[j * kLanes]) & std::uint32_t(kNumberBits);
      row_distances[j] = distance[number * kLanes];
      row_indices[j] = index[slots[number]];
    }
  }

  // False if keys alone cannot tell the k nearest.
  bool write_with_ties(const RingLayout& l, std::uint32_t lane, Row row) const {
    const std::int32_t farthest = keys[(row.k - 1) * kLanes + lane] | kNumberBits;
    if (farthest >= keys[(kKept - 1) * kLanes + lane]) return false;
    for (std::size_t j = 0; keys[j * kLanes + lane] <= farthest; ++j) {
      const std::size_t number = std::size_t(keys[j * kLanes + lane] & kNumberBits);
      row.insert(distances[number * kLanes + lane], l.index[slots[number] + lane]);
    }
    return true;
  }
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tilth
HWY_AFTER_NAMESPACE();
#endif
