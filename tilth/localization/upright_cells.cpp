#include <algorithm>
#include <cmath>
#include <numbers>

#include <tilth/localization/upright_cells.hpp>

namespace tilth {
namespace {

constexpr double kMostUpward = 0.7;      // z of the normal of what stands upright, at most
constexpr std::uint16_t kSeenOften = 2;  // patches
constexpr std::uint8_t kEveryFacing = 255;

}  // namespace

int facing_of_upright(const Eigen::Vector3d& normal) {
  const double turns = std::atan2(normal.y(), normal.x()) / (2 * std::numbers::pi);
  return (int(std::floor(turns * kUprightFacings + 0.5)) + kUprightFacings) % kUprightFacings;
}

bool stands_upright(const SurfacePatch& patch) {
  return !patch.flat || std::abs(patch.normal.z()) < kMostUpward;
}

std::uint8_t facings_of(const SurfacePatch& patch) {
  return patch.flat ? std::uint8_t(1 << facing_of_upright(patch.normal)) : kEveryFacing;
}

void UprightGatherer::add(const SurfacePatches& patches, const Pose& T_map_lidar) {
  for (const SurfacePatch& patch : patches) {
    if (!stands_upright(patch)) continue;
    SurfacePatch placed = patch;
    placed.mean = T_map_lidar * patch.mean;
    placed.normal = T_map_lidar.linear() * patch.normal;
    auto& counts = counts_[{upright_cell_of(placed.mean.y()), upright_cell_of(placed.mean.x())}];
    const std::uint8_t facings = facings_of(placed);
    for (int i = 0; i < kUprightFacings; ++i) {
      std::uint16_t& count = counts[std::size_t(i)];
      if ((facings >> i & 1) != 0 && count < kSeenOften) ++count;
    }
  }
}

std::vector<UprightCell> UprightGatherer::cells() const {
  std::vector<UprightCell> cells;
  for (const auto& [at, counts] : counts_) {
    UprightCell cell{at.second, at.first, 0};
    for (int i = 0; i < kUprightFacings; ++i)
      if (counts[std::size_t(i)] >= kSeenOften) cell.facings = std::uint8_t(cell.facings | 1 << i);
    if (cell.facings != 0) cells.push_back(cell);
  }
  return cells;
}

}  // namespace tilth
