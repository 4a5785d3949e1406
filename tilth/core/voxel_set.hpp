// A set of voxels on surfaces: a bit each, in blocks of eight voxels an edge that a hash table finds. Neighbours share
// a cache line.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <tilth/core/voxel_table.hpp>

namespace tilth {

class VoxelSet {
 public:
  VoxelSet() { clear(); }

  static constexpr int kReach = 1 << 21;  ///< voxels from the origin, along each axis, that a voxel must be within

  /// Adds `voxel`; false where it was there before.
  bool insert(const Eigen::Vector3i& voxel) {
    Eigen::Vector3i& recent = recent_of(voxel);
    if (recent == voxel) return false;
    recent = voxel;
    const std::uint32_t block = table_.insert(voxel_key(block_of(voxel), 0));
    if (block == bits_.size()) bits_.push_back({});
    std::uint64_t& word = bits_[block][layer_of(voxel)];
    const std::uint64_t bit = bit_of(voxel);
    if ((word & bit) != 0) return false;
    word |= bit;
    return true;
  }

  /// Takes `voxel` out again, if it is there.
  void erase(const Eigen::Vector3i& voxel) {
    Eigen::Vector3i& recent = recent_of(voxel);
    if (recent == voxel) recent = kNowhere;
    const std::uint32_t block = table_.find(voxel_key(block_of(voxel), 0));
    if (block != VoxelTable::kNone) bits_[block][layer_of(voxel)] &= ~bit_of(voxel);
  }

  void clear() {
    table_.clear();
    bits_.clear();
    recent_.fill(kNowhere);
  }

 private:
  static constexpr int kEdgeBits = 3, kEdge = 1 << kEdgeBits;  // of a block, in voxels

  static Eigen::Vector3i block_of(const Eigen::Vector3i& voxel) {
    return voxel.unaryExpr([](int place) { return place >> kEdgeBits; });  // rounds down, below zero too
  }

  static std::size_t layer_of(const Eigen::Vector3i& voxel) { return std::size_t(voxel.z() & (kEdge - 1)); }

  static std::uint64_t bit_of(const Eigen::Vector3i& voxel) {
    return std::uint64_t{1} << ((voxel.x() & (kEdge - 1)) * kEdge + (voxel.y() & (kEdge - 1)));
  }

  Eigen::Vector3i& recent_of(const Eigen::Vector3i& voxel) {
    return recent_[std::size_t(voxel.x() + 5 * voxel.y() + 25 * voxel.z()) % recent_.size()];
  }

  static inline const Eigen::Vector3i kNowhere = Eigen::Vector3i::Constant(kReach);

  VoxelTable table_;                                // of the blocks
  std::array<Eigen::Vector3i, 256> recent_;         // some of the last ones asked for: neighbouring points share voxels
  std::vector<std::array<std::uint64_t, 8>> bits_;  // of each block: a word a layer
};

}  // namespace tilth
