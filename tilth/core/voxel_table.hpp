// A hash table from voxels to consecutive numbers: open addressing, at most half full, a few nanoseconds a probe.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Core>

namespace tilth {

/// The voxel that holds a point, given in units of the voxels' edge: rounds down, below zero too.
inline Eigen::Vector3i voxel_of(const Eigen::Vector3d& point_in_voxels) {
  const Eigen::Vector3i towards_zero = point_in_voxels.cast<int>();
  return towards_zero - (point_in_voxels.array() < towards_zero.cast<double>().array()).cast<int>().matrix();
}

/// What a voxel key grows by from a voxel to the next one along an axis.
constexpr std::int64_t voxel_key_step(int axis) {
  return std::int64_t{1} << (43 - 20 * axis);
}

/// A voxel, and which of up to eight things in it is meant, as one integer: 20 bits an axis.
inline std::int64_t voxel_key(const Eigen::Vector3i& voxel, int kind) {
  constexpr std::int64_t kReach = 1 << 19;  // voxels from the origin
  return (voxel.x() + kReach) * voxel_key_step(0) + (voxel.y() + kReach) * voxel_key_step(1) +
         (voxel.z() + kReach) * voxel_key_step(2) + kind;
}

class VoxelTable {
 public:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  VoxelTable() { clear(); }

  /// The number of `key`, or kNone.
  std::uint32_t find(std::int64_t key) const { return slots_[slot_of(key)].number; }

  /// Has the place of `key` fetched from memory, for a find() or insert() soon after.
  void prefetch(std::int64_t key) const { __builtin_prefetch(&slots_[home_of(key)]); }

  /// The number of `key`, which is the next one, size(), if it was not there.
  std::uint32_t insert(std::int64_t key) {
    if (2 * (size_ + 1) > slots_.size()) grow();
    Slot& slot = slots_[slot_of(key)];
    if (slot.number == kNone) slot = {key, size_++};
    return slot.number;
  }

  std::uint32_t size() const { return size_; }

  void clear() {
    slots_.assign(1024, {0, kNone});
    size_ = 0;
  }

 private:
  struct Slot {
    std::int64_t key;
    std::uint32_t number;
  };

  std::size_t home_of(std::int64_t key) const {
    const std::uint64_t h = std::uint64_t(key) * 0x9E3779B97F4A7C15ull;  // Fibonacci hashing
    return std::size_t(h ^ (h >> 32)) & (slots_.size() - 1);
  }

  std::size_t slot_of(std::int64_t key) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t i = home_of(key);
    while (slots_[i].number != kNone && slots_[i].key != key) i = (i + 1) & mask;
    return i;
  }

  void grow() {
    std::vector<Slot> old(2 * slots_.size(), {0, kNone});
    old.swap(slots_);
    for (const Slot& slot : old) {
      if (slot.number != kNone) slots_[slot_of(slot.key)] = slot;
    }
  }

  std::vector<Slot> slots_;
  std::uint32_t size_ = 0;
};

}  // namespace tilth
