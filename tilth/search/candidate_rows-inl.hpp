// What a block has seen, and how rows of the table are read from its sorted keys.
#if defined(TILTH_SEARCH_CANDIDATE_ROWS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TILTH_SEARCH_CANDIDATE_ROWS_INL
#undef TILTH_SEARCH_CANDIDATE_ROWS_INL
#else
#define TILTH_SEARCH_CANDIDATE_ROWS_INL
#endif

#include <bit>

#include <hwy/highway.h>

#include <tilth/search/isolated_search-inl.hpp>
#include <tilth/search/nearest_keys-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace tilth {
namespace HWY_NAMESPACE {
namespace {

template <std::size_t kKept>
class CandidateRows {
  using D = hn::ScalableTag<float>;
  using DI = hn::RebindToSigned<D>;
  using DU = hn::RebindToUnsigned<D>;
  using Keys = hn::Vec<DI>;
  static constexpr std::uint32_t kLanes = HWY_LANES(float);

 public:
  static constexpr std::uint32_t kMostCandidates = kNumberBits - 2;  // no key equals a limit
  static constexpr std::size_t kWanted = kKept - 2;  // a key more shows ties, another leaves fewer to be settled

  /// Remembers candidate `number`: squared distances and indices, a lane each.
  HWY_INLINE void set(std::uint32_t number, hn::Vec<D> squared, const std::uint32_t* index) {
    hn::Store(squared, D(), candidates_[number].distances);
    hn::Store(hn::LoadU(DU(), index), DU(), candidates_[number].indices);
  }

  HWY_INLINE void set_keys(const Keys (&keys)[kKept]) {
    HWY_UNROLL(64) for (std::size_t j = 0; j < kKept; ++j) hn::Store(keys[j], DI(), keys_ + j * kLanes);
  }

  /// Writes the lane's row as its keys are sorted.
  HWY_INLINE void write(std::uint32_t lane, const Row& row) const {
    if (row.k != kWanted) return copy(lane, row, row.k);
    copy(lane, row, kWanted);
  }

  /// The lane's nearest k as they are seen by their keys, offered to a search.
  HWY_INLINE void offer(std::uint32_t lane, NearestRow& row) const {
    for (std::size_t j = 0; j < row.k(); ++j) insert(lane, j, row);
  }

  /// A squared distance within which the lane has its nearest k.
  HWY_INLINE float limit(std::uint32_t lane, std::size_t k) const {
    return std::bit_cast<float>(keys_[(k - 1) * kLanes + lane] | kNumberBits);
  }

  /// Offers all others that may be as near. False if that is more than the keys tell.
  bool offer_ties(std::uint32_t lane, NearestRow& row) const {
    const std::int32_t farthest = keys_[(row.k() - 1) * kLanes + lane] | kNumberBits;
    if (farthest >= keys_[(kKept - 1) * kLanes + lane]) return false;
    for (std::size_t j = row.k(); keys_[j * kLanes + lane] <= farthest; ++j) insert(lane, j, row);
    return true;
  }

 private:
  struct Candidate {
    float distances[kLanes];
    std::uint32_t indices[kLanes];
  };

  HWY_INLINE const Candidate& candidate(std::uint32_t lane, std::size_t j) const {
    return candidates_[std::uint32_t(keys_[j * kLanes + lane]) & std::uint32_t(kNumberBits)];
  }

  HWY_INLINE void insert(std::uint32_t lane, std::size_t j, NearestRow& row) const {
    const Candidate& c = candidate(lane, j);
    row.insert(c.distances[lane], c.indices[lane]);
  }

  HWY_INLINE void copy(std::uint32_t lane, const Row& row, std::size_t k) const {
    float* HWY_RESTRICT const distances = row.distances;
    std::uint32_t* HWY_RESTRICT const indices = row.indices;
    HWY_UNROLL(32) for (std::size_t j = 0; j < k; ++j) {
      const Candidate& c = candidate(lane, j);
      distances[j] = c.distances[lane];
      indices[j] = c.indices[lane];
    }
  }

  alignas(64) Candidate candidates_[kMostCandidates];
  alignas(64) std::int32_t keys_[kKept * kLanes];
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tilth
HWY_AFTER_NAMESPACE();
#endif
