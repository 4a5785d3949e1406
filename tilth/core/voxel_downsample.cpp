#include <cassert>
#include <cmath>
#include <type_traits>

#include <tilth/core/voxel_downsample.hpp>
#include <tilth/core/voxel_table.hpp>

namespace tilth {
namespace {

// Which cell each point is in, and how many points each cell holds.
struct Cells {
  std::vector<std::uint32_t> cell_of;
  std::vector<std::uint32_t> counts;
};

Cells cells_of(const std::vector<Eigen::Vector3d>& points, double size) {
  Cells cells;
  cells.cell_of.reserve(points.size());
  VoxelTable table;
  const double per_metre = 1 / size;
  for (const Eigen::Vector3d& p : points) {
    const Eigen::Vector3i voxel = (p * per_metre).array().floor().cast<int>();
    const std::uint32_t cell = table.insert(voxel_key(voxel, 0));
    if (cell == cells.counts.size()) cells.counts.push_back(0);
    ++cells.counts[cell];
    cells.cell_of.push_back(cell);
  }
  return cells;
}

// The mean of `values` in each cell, in whole numbers where T is one; none where a cloud lacks the attribute.
template <class Sum, class T>
std::vector<T> means(const std::vector<T>& values, const Cells& cells, const Sum& zero) {
  if (values.empty()) return {};
  std::vector<Sum> sums(cells.counts.size(), zero);
  for (std::size_t i = 0; i < values.size(); ++i) sums[cells.cell_of[i]] += values[i];
  std::vector<T> result(sums.size());
  for (std::size_t c = 0; c < sums.size(); ++c) {
    const Sum mean = sums[c] / double(cells.counts[c]);
    if constexpr (std::is_integral_v<T>)
      result[c] = T(std::lround(mean));
    else
      result[c] = T(mean);
  }
  return result;
}

}  // namespace

PointCloud voxel_downsample(const PointCloud& cloud, double size) {
  assert(size > 0);
  const Cells cells = cells_of(cloud.points, size);
  return {means(cloud.points, cells, Eigen::Vector3d(Eigen::Vector3d::Zero())), means(cloud.intensities, cells, 0.0),
          means(cloud.times, cells, 0.0), means(cloud.rings, cells, 0.0)};
}

}  // namespace tilth
