// Voxels that grow with the distance from the origin, so that as many beams of a sensor there meet in far ones as in
// near ones: four sizes, each twice the one before.
#pragma once

#include <array>
#include <cmath>

#include <tilth/core/voxel_table.hpp>

namespace tilth {

class RangeGrid {
 public:
  /// `edge` [m] is the least of a voxel, `angle` [rad] the least that its edge spans seen from the origin.
  RangeGrid(double edge, double angle) {
    for (std::size_t level = 0; level < kLevels; ++level, edge *= 2) {
      per_metre_[level] = 1 / edge;
      greatest_squared_[level] = std::pow(edge / angle, 2);
    }
  }

  /// The voxel of a point [m], as the key of a VoxelTable. Grids of another `number`, -8 to 7, share no voxel with this
  /// one; `shift`, in edges, moves the grid.
  std::int64_t key(const Eigen::Vector3d& point, int number = 0, double shift = 0.0) const {
    constexpr int kApart = 1 << 16;  // voxels: as far as points may be
    const double squared = point.squaredNorm();
    std::size_t level = 0;
    while (level + 1 < kLevels && squared > greatest_squared_[level]) ++level;
    Eigen::Vector3i voxel = voxel_of(point * per_metre_[level] + Eigen::Vector3d::Constant(shift));
    voxel.x() += number * kApart;
    return voxel_key(voxel, int(level));
  }

 private:
  static constexpr std::size_t kLevels = 4;
  std::array<double, kLevels> per_metre_, greatest_squared_;  // [1/m] of a voxel's edge; [m^2] of the range
};

}  // namespace tilth
