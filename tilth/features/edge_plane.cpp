#include <algorithm>
#include <cmath>

#include <tilth/core/evenly_chosen.hpp>
#include <tilth/core/voxel_table.hpp>
#include <tilth/features/edge_plane.hpp>

namespace tilth {
namespace {

using Indices = std::vector<std::uint32_t>;
using Sector = std::span<const std::uint32_t>;

// The candidates of each ring in the order in which they were fired.
std::vector<Indices> rings_of(const PointCloud& cloud, std::span<const float> curvature) {
  std::vector<Indices> rings(1);
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    if (curvature[i] <= 0) continue;
    const std::size_t ring = cloud.has_rings() ? cloud.rings[i] : 0;
    if (ring >= rings.size()) rings.resize(ring + 1);
    rings[ring].push_back(i);
  }
  std::erase_if(rings, [](const Indices& ring) { return ring.empty(); });
  return rings;
}

// Shares `total` among `parts` so that any run of parts has its fair share.
std::size_t quota(std::size_t total, std::size_t part, std::size_t parts) {
  return total * (part + 1) / parts - total * part / parts;
}

// The most curved points first, none within `spacing` places of one already taken.
void take_edges(Sector sector, std::span<const float> curvature, std::size_t count, const FeatureOptions& options,
                Indices& edges) {
  Indices order;
  for (std::uint32_t i = 0; i < sector.size(); ++i) {
    if (curvature[sector[i]] >= options.min_edge_curvature) order.push_back(i);
  }
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(-curvature[sector[a]], a) < std::pair(-curvature[sector[b]], b);
  });
  Indices taken;
  for (const std::uint32_t i : order) {
    if (taken.size() == count) break;
    const auto near = [&](std::uint32_t j) { return std::abs(int(i) - int(j)) <= options.edge_spacing; };
    if (std::none_of(taken.begin(), taken.end(), near)) taken.push_back(i);
  }
  for (const std::uint32_t i : taken) edges.push_back(sector[i]);
}

// The least curved candidate of each cell of a grid: near walls, seen thousands of times, count no more than far floor.
Indices flattest_of_cells(const PointCloud& cloud, std::span<const float> curvature, const FeatureOptions& options) {
  VoxelTable cells;
  Indices flattest;
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    if (curvature[i] <= 0 || curvature[i] > options.max_plane_curvature) continue;
    const std::uint32_t cell = cells.insert(voxel_key(voxel_of(cloud.points[i] / options.plane_cell), 0));
    if (cell == flattest.size())
      flattest.push_back(i);
    else if (curvature[i] < curvature[flattest[cell]])
      flattest[cell] = i;
  }
  return flattest;
}

}  // namespace

float corrected_curvature(const Eigen::Matrix3f& sigma) {
  const float norm = sigma.norm();
  return norm > 0 ? sigma.trace() / norm : 0.0f;
}

std::vector<std::uint32_t> select_edges(const PointCloud& cloud, std::span<const float> curvature,
                                        const FeatureOptions& options) {
  Indices edges;
  const std::vector<Indices> rings = rings_of(cloud, curvature);
  const std::size_t sectors = std::size_t(options.sectors), parts = rings.size() * sectors;
  for (std::size_t part = 0; part < parts; ++part) {
    const Indices& ring = rings[part / sectors];
    const std::size_t begin = ring.size() * (part % sectors) / sectors,
                      end = ring.size() * (part % sectors + 1) / sectors;
    const Sector sector(ring.data() + begin, end - begin);
    take_edges(sector, curvature, quota(std::size_t(options.edges), part, parts), options, edges);
  }
  return edges;
}

std::vector<std::uint32_t> select_planes(const PointCloud& cloud, std::span<const float> curvature,
                                         const FeatureOptions& options) {
  return evenly_chosen<std::uint32_t>(flattest_of_cells(cloud, curvature, options), std::size_t(options.planes));
}

}  // namespace tilth
