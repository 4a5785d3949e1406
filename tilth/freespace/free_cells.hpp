// Which cells beams have passed through, and which hold surfaces: four bits a cell in blocks of four cells an edge,
// that a hash table finds.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <tilth/core/voxel_table.hpp>

namespace tilth {

class FreeCells {
 public:
  static constexpr std::uint32_t kNone = VoxelTable::kNone;
  static constexpr int kMostPasses = 3;  ///< counted

  struct Block {
    Eigen::Vector3i place;                  ///< in blocks
    std::uint64_t surface = 0;              ///< cells with points, a bit each
    std::array<std::uint64_t, 3> passes{};  ///< cells that one, two, three beams passed
    std::uint32_t surfaces = kNone;         ///< number of its SurfaceBlock

    void pass(std::uint64_t bit) {
      passes[2] |= passes[1] & bit;
      passes[1] |= passes[0] & bit;
      passes[0] |= bit;
    }
  };

  static int bit_of(const Eigen::Vector3i& cell) { return (cell.x() & 3) | (cell.y() & 3) << 2 | (cell.z() & 3) << 4; }

  static Eigen::Vector3i block_of(const Eigen::Vector3i& cell) { return {cell.x() >> 2, cell.y() >> 2, cell.z() >> 2}; }

  /// The block of that place, made where it is missing.
  std::uint32_t insert(const Eigen::Vector3i& block) {
    const std::uint32_t number = table_.insert(voxel_key(block, 0));
    if (number == blocks_.size()) blocks_.emplace_back().place = block;
    return number;
  }

  /// The block of that place, or nullptr.
  const Block* find(const Eigen::Vector3i& block) const {
    const std::uint32_t number = table_.find(voxel_key(block, 0));
    return number == kNone ? nullptr : &blocks_[number];
  }

  Block& operator[](std::uint32_t number) { return blocks_[number]; }

  /// Beams that passed the cell, kMostPasses at most.
  int passes(const Eigen::Vector3i& cell) const {
    const Block* block = find(block_of(cell));
    if (block == nullptr) return 0;
    int count = 0;
    for (const std::uint64_t word : block->passes) count += int(word >> bit_of(cell) & 1U);
    return count;
  }

  const std::vector<Block>& blocks() const { return blocks_; }

 private:
  VoxelTable table_;
  std::vector<Block> blocks_;
};

}  // namespace tilth
