// The search of neighbours on laid out rings, compiled once for each instruction set and chosen at run time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <tilth/search/ring_layout.hpp>
#include <tilth/search/scan_neighbors.hpp>

namespace tilth {

/// The most neighbours that search_rings() can find.
inline constexpr std::size_t kMostRingNeighbors = 30;

/// What a search keeps besides its result; one object serves scan after scan.
struct SearchBuffers {
  std::vector<std::uint32_t> cursors;  ///< where each ring was last entered
  ChunkBoxes boxes;
};

/// Fills the table, whose size is set, for every point of the layout. 1 <= k <= kMostRingNeighbors, k < points.
void search_rings(const RingLayout& layout, SearchBuffers& buffers, NeighborTable& table);

}  // namespace tilth
