// What changed in a scene while it was mapped: things that stood for a while and left, and things that came where beams
// had passed and stayed. Points that changed are one thing where they lie within reach of one another and stood at the
// same time. O(points).
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

namespace tilth {

enum class ChangeKind : std::uint8_t { left, came };

std::string_view name_of(ChangeKind kind);  ///< "left" or "came"

/// When something that changed was there.
struct Stay {
  ChangeKind kind = ChangeKind::left;
  double first_seen = 0.0, last_seen = 0.0;  ///< [s]
  double free_until = 0.0;                   ///< [s] when beams last passed where something came
};

/// A point that changed, one a voxel.
struct ChangedPoint {
  Eigen::Vector3f point;  ///< [m] in the world
  Stay stay;
};

/// A thing that changed, as far as it was seen.
struct Change {
  Stay stay;
  Eigen::AlignedBox3f box;  ///< [m] in the world
  std::size_t points = 0;
};

/// The things that `points` are of, in the order in which they changed. What is too small to be told from stray points
/// is left out, and what came bit by bit: beams pass, as far as anybody can tell, through metal and glass. Points of
/// one thing were there at times at most `apart` [s] from one another.
std::vector<Change> changes_of(std::span<const ChangedPoint> points, double apart = 1.0);

}  // namespace tilth
