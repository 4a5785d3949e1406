// The points of a cell as two parallel layers, where they are two.
#pragma once

#include <optional>
#include <span>

#include <tilth/assessment/doubled_walls.hpp>

namespace tilth {

/// What a cell holds.
struct CellLayers {
  bool planar = false;                   ///< one surface, or two that are parallel
  std::optional<DoubledWall> doubled{};  ///< two
};

CellLayers layers_of(std::span<const ScannedPoint> cell);

}  // namespace tilth
