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

// Sector by sector, so that whatever the order of the cloud its rows are written in places near one another.
template <std::size_t kKept>
void search_all(const RingLayout& layout, SearchBuffers& buffers, NeighborTable& table) {
  BlockSearch<kKept> search(layout, buffers, table);
  std::uint32_t longest = 0;
  for (const Ring& ring : layout.rings) longest = std::max(longest, ring.count);
  for (std::uint32_t i = 0; i < longest; i += HWY_LANES(float)) {
    for (std::uint32_t r = 0; r < layout.rings.size(); ++r) {
      if (i < layout.rings[r].count) search.search_block(r, i);
    }
  }
}

// One candidate more than k must be kept, to see ties; two leave fewer of them to be settled one by one.
void search_rings_simd(const RingLayout& layout, SearchBuffers& buffers, NeighborTable& table) {
  if (table.k <= 10) return search_all<12>(layout, buffers, table);
  if (table.k <= 20) return search_all<22>(layout, buffers, table);
  search_all<32>(layout, buffers, table);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tilth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tilth {

HWY_EXPORT(search_rings_simd);

void search_rings(const RingLayout& layout, SearchBuffers& buffers, NeighborTable& table) {
  HWY_DYNAMIC_DISPATCH(search_rings_simd)(layout, buffers, table);
}

}  // namespace tilth
#endif
