// What stands upright in a map, seen from above: cells of a grid with the ways that surfaces in them face. Small enough
// to be searched as a whole; poles and whatever has no side count for every way. Kept ordered, so that equal maps have
// equal cells.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include <tilth/core/surface_patch.hpp>

namespace tilth {

inline constexpr double kUprightCell = 0.5;  ///< [m] edge of a cell
inline constexpr int kUprightFacings = 8;    ///< of a full turn

struct UprightCell {
  std::int32_t x = 0, y = 0;  ///< rounded coordinates in cells
  std::uint8_t facings = 0;   ///< bit i: a surface faces i eighths of a turn to the left of +x
};

/// Which eighth of a turn a direction in the plane is nearest to.
int facing_of_upright(const Eigen::Vector3d& normal);

/// Whether a patch tells where something stands: a wall, a pole, but not a floor.
bool stands_upright(const SurfacePatch& patch);

/// The bits of UprightCell::facings that a patch sets.
std::uint8_t facings_of(const SurfacePatch& patch);

/// The cell of a coordinate [m].
inline std::int32_t upright_cell_of(double x) {
  return std::int32_t(std::lround(x / kUprightCell));
}

/// Gathers the cells of a map, scan by scan. O(patches log cells).
class UprightGatherer {
 public:
  void add(const SurfacePatches& patches, const Pose& T_map_lidar);

  /// Those that were seen often enough, by y and then x.
  std::vector<UprightCell> cells() const;

 private:
  std::map<std::pair<std::int32_t, std::int32_t>, std::array<std::uint16_t, kUprightFacings>> counts_;  // by (y, x)
};

}  // namespace tilth
