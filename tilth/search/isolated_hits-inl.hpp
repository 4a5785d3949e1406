// The candidates of one point that are within a limit, as they come, a vector at a time. The limit is lowered when
// there are many more than can be of use: by counting how many are within guesses of it, which needs no order among
// them.
#if defined(TILTH_SEARCH_ISOLATED_HITS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TILTH_SEARCH_ISOLATED_HITS_INL
#undef TILTH_SEARCH_ISOLATED_HITS_INL
#else
#define TILTH_SEARCH_ISOLATED_HITS_INL
#endif

#include <algorithm>
#include <bit>
#include <cmath>

#include <hwy/highway.h>

#include <tilth/search/compress-inl.hpp>
#include <tilth/search/nearest_row.hpp>

HWY_BEFORE_NAMESPACE();
namespace tilth {
namespace HWY_NAMESPACE {
namespace {

class IsolatedHits {
  using D = hn::ScalableTag<float>;
  using DU = hn::RebindToUnsigned<D>;
  static constexpr std::uint32_t kLanes = HWY_LANES(float);
  static constexpr std::uint32_t kMost = 96;  // hits before they are thinned
  static constexpr std::uint32_t kSpare = 4;  // hits that thinning may leave besides those that are wanted
  static constexpr int kMostGuesses = 24;

 public:
  /// For a point whose k nearest others are within the squared distance `limit`.
  void begin(std::size_t k, float limit) {
    k_ = std::uint32_t(k);
    limit_ = limit;
    count_ = 0;
  }

  float limit() const { return limit_; }
  void clear() { count_ = 0; }

  /// Takes those of a vector of candidates that are near and in `valid`. False if more are equally near than it holds.
  HWY_INLINE bool take(hn::Vec<D> squared, const std::uint32_t* index, hn::Mask<D> valid) {
    const D d;
    const auto near = hn::And(hn::Le(squared, hn::Set(d, limit_)), valid);
    const Marked<D> marked(d, near);
    marked.store(DU(), hn::LoadU(DU(), index), indices_ + count_);
    marked.store(d, squared, distances_ + count_);
    count_ += marked.count();
    return count_ <= kMost || thin();
  }

  /// Lowers the limit as far as the k nearest others are sure to be among the hits; the point itself may be one too.
  HWY_NOINLINE bool thin() {
    const std::uint32_t most = k_ + 1 + kSpare;
    float low = 0.0f, high = farthest();
    std::uint32_t below = 0, hits = count_;
    for (int i = 0; i < kMostGuesses && hits > most; ++i) {
      const float ratio = float(k_ + 1 + kSpare / 2 - below) / float(hits - below);
      const float guess = i % 3 == 2 ? std::sqrt(std::max(low, 1e-6f * high) * high) : low + (high - low) * ratio;
      const std::uint32_t count = count_within(guess);
      (count <= k_ ? low : high) = guess;
      (count <= k_ ? below : hits) = count;
    }
    if (count_ > k_) limit_ = std::min(limit_, high);
    keep_within(limit_);
    return count_ <= kMost;
  }

  /// The row of the point `self`, by distance, then by index. At least k others must have been taken.
  void write(std::uint32_t self, const Row& row) {
    thin();
    std::uint64_t entries[kMost + 1];
    std::uint32_t n = 0;
    for (std::uint32_t j = 0; j < count_; ++j) {
      if (indices_[j] != self) entries[n++] = NearestRow::entry(distances_[j], indices_[j]);
    }
    std::sort(entries, entries + n);
    for (std::size_t j = 0; j < row.k; ++j) {
      row.distances[j] = std::bit_cast<float>(std::uint32_t(entries[j] >> 32));
      row.indices[j] = std::uint32_t(entries[j]);
    }
  }

 private:
  HWY_INLINE float farthest() const {
    const D d;
    auto most = hn::Zero(d);
    for (std::uint32_t j = 0; j < count_; j += kLanes) {
      most = hn::Max(most, hn::IfThenElseZero(hn::FirstN(d, count_ - j), hn::Load(d, distances_ + j)));
    }
    return hn::GetLane(hn::MaxOfLanes(d, most));
  }

  HWY_INLINE std::uint32_t count_within(float limit) const {
    const D d;
    std::uint32_t count = 0;
    for (std::uint32_t j = 0; j < count_; j += kLanes) {
      const auto within = hn::Le(hn::Load(d, distances_ + j), hn::Set(d, limit));
      count += std::uint32_t(hn::CountTrue(d, hn::And(within, hn::FirstN(d, count_ - j))));
    }
    return count;
  }

  HWY_INLINE void keep_within(float limit) {
    const D d;
    std::uint32_t kept = 0;
    for (std::uint32_t j = 0; j < count_; j += kLanes) {
      const auto squared = hn::Load(d, distances_ + j);
      const auto index = hn::Load(DU(), indices_ + j);
      const auto within = hn::And(hn::Le(squared, hn::Set(d, limit)), hn::FirstN(d, count_ - j));
      const Marked<D> marked(d, within);
      marked.store(DU(), index, indices_ + kept);
      marked.store(d, squared, distances_ + kept);
      kept += marked.count();
    }
    count_ = kept;
  }

  alignas(64) float distances_[kMost + 32];
  alignas(64) std::uint32_t indices_[kMost + 32];
  std::uint32_t k_ = 0, count_ = 0;
  float limit_ = 0.0f;
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tilth
HWY_AFTER_NAMESPACE();
#endif
