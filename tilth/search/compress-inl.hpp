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

/// Stores the marked lanes of two vectors, and whatever up to a whole vector, at `to_a` and `to_b`. How many they are.
template <class D, class DI>
HWY_INLINE std::uint32_t compress_two(D d, DI di, hn::Mask<D> mask, hn::Vec<D> a, hn::Vec<DI> b, hn::TFromD<D>* to_a,
                                      hn::TFromD<DI>* to_b) {
  if constexpr (HWY_LANES(float) > 8) {
    hn::CompressStore(b, hn::RebindMask(di, mask), di, to_b);
    return std::uint32_t(hn::CompressStore(a, mask, d, to_a));
  } else {
    static constexpr FrontLanes<HWY_LANES(float)> kFront;
    const std::uint32_t bits = lane_bits(d, mask);
    const hn::Rebind<std::uint8_t, D> bytes;
    const auto lanes = hn::PromoteTo(hn::RebindToSigned<D>(), hn::LoadU(bytes, kFront.lanes[bits]));
    hn::StoreU(hn::TableLookupLanes(a, hn::IndicesFromVec(d, lanes)), d, to_a);
    hn::StoreU(hn::TableLookupLanes(b, hn::IndicesFromVec(di, lanes)), di, to_b);
    return std::uint32_t(std::popcount(bits));
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tilth
HWY_AFTER_NAMESPACE();
#endif
