#include <tilth/search/scan_kernel.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tilth/search/scan_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <tilth/search/block_search-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace tilth {
namespace HWY_NAMESPACE {
namespace {

template <std::size_t kKept>
void search_all(const RingLayout& layout, NeighborTable& table) {
  BlockSearch<kKept> search(layout, table);
  for (std::uint32_t r = 0; r < layout.rings.size(); ++r) {
    search.enter_ring(r);
    for (std::uint32_t i = 0; i < layout.rings[r].count; i += HWY_LANES(float)) search.search_block(i);
  }
}

// One candidate more than k must be kept, to see ties; two leave fewer of them to be settled one by one.
void search_rings_simd(const RingLayout& layout, NeighborTable& table) {
  if (table.k <= 6) return search_all<8>(layout, table);
  if (table.k <= 10) return search_all<12>(layout, table);
  if (table.k <= 14) return search_all<16>(layout, table);
  if (table.k <= 22) return search_all<24>(layout, table);
  if (table.k <= 30) return search_all<32>(layout, table);
  search_all<64>(layout, table);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tilth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tilth {

HWY_EXPORT(search_rings_simd);

void search_rings(const RingLayout& layout, NeighborTable& table) {
  HWY_DYNAMIC_DISPATCH(search_rings_simd)(layout, table);
}

}  // namespace tilth
#endif
