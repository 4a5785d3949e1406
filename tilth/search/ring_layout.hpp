// The points of a scan laid out ring by ring in the order of their azimuth, as structure of arrays: what the search of
// neighbours reads. Works for rings stored one after another or firing by firing. O(n) where rings come in order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <tilth/core/point_cloud.hpp>

namespace tilth {

/// An elevation above the horizontal plane.
struct Elevation {
  float angle = 0.0f;  ///< [rad]
  float sin = 0.0f;
  float cos = 1.0f;
};

/// Where a ring lies in the arrays, and the elevations between which all its points are seen.
struct Ring {
  std::uint32_t begin = 0;
  std::uint32_t count = 0;
  Elevation low, high;
  Elevation lowest_above;   ///< the lowest `low` of this ring and of all that follow
  Elevation highest_below;  ///< the highest `high` of this ring and of all before
};

struct RingLayout {
  /// Slots on both sides of a ring in which its points go on round the circle, so that windows are plain loads.
  static constexpr std::uint32_t kPad = 96;
  static constexpr float kTurn = 4.0f;  ///< of the azimuths

  std::vector<Ring> rings;           ///< upwards; none is empty
  std::vector<float> x, y, z;        ///< [m] a slot each; y is mirrored where the sensor turns clockwise
  bool mirrored = false;             ///< whether it does
  std::vector<float> ux, uy;         ///< unit horizontal direction (any, for points on the axis)
  std::vector<float> azimuth;        ///< pseudo angle, kTurn a turn: ascending in each ring, pads included
  std::vector<std::uint32_t> index;  ///< of the point in the cloud
};

/// Boxes [m], a lane each.
struct Boxes {
  std::vector<float> low_x, high_x, low_y, high_y, low_z, high_z;

  void clear() {
    for (std::vector<float>* v : {&low_x, &high_x, &low_y, &high_y, &low_z, &high_z}) v->clear();
  }
};

/// Boxes around runs of slots, and around groups of these; empty until a search needs them.
struct ChunkBoxes {
  Boxes runs, groups;
  std::vector<std::uint32_t> slots, counts;  ///< of each run
  std::vector<float> distances;              ///< [m^2] from a point to all groups

  bool empty() const { return slots.empty(); }
  void clear() {
    runs.clear();
    groups.clear();
    slots.clear();
    counts.clear();
  }
};

/// Lays out `cloud`. False where its rings give no order to search by: no rings, or rings that overlap in elevation.
bool arrange(const PointCloud& cloud, RingLayout& layout);

}  // namespace tilth
