// The marked lanes of a vector, moved to its front. Highway 1.0's CompressStore copies its whole table to the stack at
// each call where GCC compiles it, so up to eight lanes this is done by a table of our own.
#if defined(TILTH_SEARCH_COMPRESS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TILTH_SEARCH_COMPRESS_INL
#undef TILTH_SEARCH_COMPRESS_INL
#else
#define TILTH_SEARCH_COMPRESS_INL
#endif

#include <bit>
#include <cstdint>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace tilth {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// Bit i is set where lane i is.
template <class D>
HWY_INLINE std::uint32_t lane_bits(D d, hn::Mask<D> mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(d, mask, bytes);
  return bytes[0] | std::uint32_t(bytes[1]) << 8;
}

template <std::uint32_t kLanes>
struct FrontLanes {
  std::uint8_t lanes[1u << kLanes][kLanes] = {};

  constexpr FrontLanes() {
    for (std::uint32_t bits = 0; bits < 1u << kLanes; ++bits) {
      std::uint32_t count = 0;
      for (std::uint32_t i = 0; i < kLanes; ++i) {
        if ((bits >> i & 1) != 0) lanes[bits][count++] = std::uint8_t(i);
      }
    }
  }
};

/// The marked lanes, of as many vectors as are stored.
template <class D>
class Marked {
 public:
  HWY_INLINE Marked(D d, hn::Mask<D> mask) : mask_(mask), bits_(lane_bits(d, mask)) {}

  HWY_INLINE std::uint32_t count() const { return std::uint32_t(std::popcount(bits_)); }

  /// Stores those of `v`, and whatever up to a whole vector.
  template <class DV>
  HWY_INLINE void store(DV d, hn::Vec<DV> v, hn::TFromD<DV>* to) const {
    if constexpr (HWY_LANES(float) > 8) {
      hn::CompressStore(v, hn::RebindMask(d, mask_), d, to);
    } else {
      static constexpr FrontLanes<HWY_LANES(float)> kFront;
      const auto bytes = hn::LoadU(hn::Rebind<std::uint8_t, D>(), kFront.lanes[bits_]);
      const auto lanes = hn::PromoteTo(hn::RebindToSigned<D>(), bytes);
      hn::StoreU(hn::TableLookupLanes(v, hn::IndicesFromVec(d, lanes)), d, to);
    }
  }

 private:
  hn::Mask<D> mask_;
  std::uint32_t bits_;
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tilth
HWY_AFTER_NAMESPACE();
#endif
