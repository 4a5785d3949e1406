// The part of a turn in which a cloud has points. O(n).
#pragma once

#include <span>

#include <Eigen/Core>

namespace tilth {

/// [rad] counter-clockwise from `begin`; all of the turn but its longest stretch without points.
struct AzimuthArc {
  double begin = 0.0, width = 0.0;
  double centre() const { return begin + 0.5 * width; }
};

/// To a degree. Without points the width is 0.
AzimuthArc arc_of(std::span<const Eigen::Vector3d> points);

}  // namespace tilth
