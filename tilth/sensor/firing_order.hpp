// A spin read back from the order of the points. Spinning LiDARs emit points in the order of their firing, so azimuth
// advances with the index while the beams interleave: time = azimuth progress / spin rate. Beams may be offset in
// azimuth (RS-16 10 deg), which an isotonic fit (pool adjacent violators) per scan takes out. O(n).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace tilth {

struct HeadRotation {
  std::vector<double> progress;  ///< [rad] >= 0, ascending: how far the head had turned since the first point
  double begin = 0.0;            ///< [rad] azimuth of the head at the first point
  bool clockwise = true;         ///< seen from +z
  bool ray_grid = false;  ///< starts at +-180 deg, counter-clockwise, columns without width: a ray caster's snapshot

  double covered() const { return progress.back(); }  ///< [rad]
  double end() const { return begin + (clockwise ? -covered() : covered()); }
};

/// The rotation that wrote `points`, or nothing where they are not in firing order over at most six turns.
/// `rings` has one entry a point, or none.
std::optional<HeadRotation> find_head_rotation(std::span<const Eigen::Vector3d> points,
                                               std::span<const std::uint16_t> rings);

/// First point of each ring where each beam's turn is stored after the other (KITTI .bin, organised clouds), or
/// nothing. Rows follow one another in elevation, 8 to 128 of them.
std::optional<std::vector<std::uint32_t>> find_rows(std::span<const Eigen::Vector3d> points);

}  // namespace tilth
