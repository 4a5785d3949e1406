// Voxels in blocks of two an edge: the eight voxels around a point lie in three blocks or so, each found at once.
#pragma once

#include <array>
#include <cstdint>

#include <tilth/core/voxel_table.hpp>

namespace tilth {

/// The voxels of a block that lie below and above its middle along each axis.
inline constexpr std::array<std::array<std::uint8_t, 2>, 3> kHalves{{{0x55, 0xAA}, {0x33, 0xCC}, {0x0F, 0xF0}}};

inline Eigen::Vector3i block_of(const Eigen::Vector3i& voxel) {
  return {voxel.x() >> 1, voxel.y() >> 1, voxel.z() >> 1};
}

inline std::uint32_t cell_of(const Eigen::Vector3i& voxel) {
  return std::uint32_t((voxel.x() & 1) + 2 * (voxel.y() & 1) + 4 * (voxel.z() & 1));
}

/// The blocks that eight voxels, two an edge, lie in, and which of theirs these are.
struct EightVoxels {
  std::array<std::int64_t, 8> block_keys;
  std::array<std::uint8_t, 8> cells;
  std::size_t blocks = 1;

  EightVoxels(const Eigen::Vector3i& lowest, int kind) {
    block_keys[0] = voxel_key(block_of(lowest), kind);
    cells[0] = 0xFF;
    for (int axis = 0; axis < 3; ++axis) {
      if ((lowest[axis] & 1) == 0) continue;
      for (std::size_t i = 0; i < blocks; ++i) {
        block_keys[blocks + i] = block_keys[i] + voxel_key_step(axis);
        cells[blocks + i] = cells[i] & kHalves[std::size_t(axis)][0];
        cells[i] &= kHalves[std::size_t(axis)][1];
      }
      blocks *= 2;
    }
  }
};

}  // namespace tilth
