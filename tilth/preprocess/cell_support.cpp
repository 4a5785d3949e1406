#include <utility>

#include <tilth/core/range_grid.hpp>
#include <tilth/preprocess/cell_support.hpp>

namespace tilth {
namespace {

constexpr double kEdge = 0.4, kAngle = 0.03;  // [m, rad] of a cell: its edge, at least, and what that spans
constexpr std::uint32_t kFewest = 3;          // points of a cell that are no outliers

void keep_in_company(const PointCloud& cloud, double shift, std::vector<std::uint8_t>& keep) {
  const RangeGrid grid(kEdge, kAngle);
  VoxelTable table;
  std::vector<std::uint32_t> cell_of(cloud.size()), counts;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    cell_of[i] = table.insert(grid.key(cloud.points[i], 0, shift));
    if (cell_of[i] == counts.size()) counts.push_back(0);
    ++counts[cell_of[i]];
  }
  for (std::size_t i = 0; i < cloud.size(); ++i) keep[i] |= std::uint8_t(counts[cell_of[i]] >= kFewest);
}

}  // namespace

std::vector<std::uint8_t> cell_support(const PointCloud& cloud) {
  std::vector<std::uint8_t> keep(cloud.size(), 0);
  for (const double shift : {0.0, 0.5}) keep_in_company(cloud, shift, keep);
  return keep;
}

std::vector<std::uint8_t> supported(const PointCloud& cloud, const RingLayout& rings,
                                    const RingSupportOptions& options) {
  if (!cloud.has_rings()) return cell_support(cloud);
  std::optional<std::vector<std::uint8_t>> keep = ring_support(rings, cloud.size(), options);
  return keep ? std::move(*keep) : std::vector<std::uint8_t>(cloud.size(), 1);
}

}  // namespace tilth
