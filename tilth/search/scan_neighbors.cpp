#include <algorithm>

#include <tilth/search/kdtree.hpp>
#include <tilth/search/ring_layout.hpp>
#include <tilth/search/scan_kernel.hpp>
#include <tilth/search/scan_neighbors.hpp>

namespace tilth {
namespace {

// The k nearest besides the point itself, by a tree.
void search_tree(const PointCloud& cloud, NeighborTable& table) {
  const KdTree tree(cloud.points);
  std::vector<Neighbor> found;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    tree.knn(cloud.points[i], table.k + 1, found);
    const auto self = std::find_if(found.begin(), found.end(), [&](const Neighbor& n) { return n.index == i; });
    found.erase(self == found.end() ? found.end() - 1 : self);  // more duplicates than k may hide the point itself
    for (std::size_t j = 0; j < table.k; ++j) {
      table.indices[i * table.k + j] = found[j].index;
      table.squared_distances[i * table.k + j] = float(found[j].squared_distance);
    }
  }
}

}  // namespace

struct ScanNeighbors::Buffers {
  RingLayout layout;
  SearchBuffers search;
  NeighborTable table;
};

ScanNeighbors::ScanNeighbors() : buffers_(std::make_unique<Buffers>()) {}
ScanNeighbors::ScanNeighbors(ScanNeighbors&&) noexcept = default;
ScanNeighbors& ScanNeighbors::operator=(ScanNeighbors&&) noexcept = default;
ScanNeighbors::~ScanNeighbors() = default;

const NeighborTable& ScanNeighbors::compute(const PointCloud& cloud, std::size_t k) {
  NeighborTable& table = buffers_->table;
  table.k = cloud.empty() ? 0 : std::min(k, cloud.size() - 1);
  table.indices.resize(cloud.size() * table.k);
  table.squared_distances.resize(cloud.size() * table.k);
  if (table.k == 0) return table;
  if (table.k <= kMostRingNeighbors && arrange(cloud, buffers_->layout)) {
    search_rings(buffers_->layout, buffers_->search, table);
  } else {
    search_tree(cloud, table);
  }
  return table;
}

NeighborTable scan_neighbors(const PointCloud& cloud, std::size_t k) {
  ScanNeighbors search;
  return search.compute(cloud, k);
}

}  // namespace tilth
