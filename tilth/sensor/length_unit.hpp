// In which unit of length coordinates are: told by the ranges of a scan, which in metres no LiDAR measures as they are
// in centimetres or millimetres. O(n).
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace tilth {

enum class LengthUnit { automatic, metres, centimetres, millimetres };
std::span<const std::string_view> names_of(LengthUnit);

/// [m] of one unit.
double metres_of(LengthUnit unit);

/// How far a scan reaches: decimal logarithms in its own unit.
struct ScanExtent {
  double range = 0.0;   ///< mean of those of the 1st, 50th and 99th percentile of the ranges
  double height = 0.0;  ///< of the 5th percentile of z, as far as it is below or above 0: about the sensor's height
};

/// Of the points that are finite and not (0, 0, 0); nothing where they are fewer than 20.
std::optional<ScanExtent> extent_of(std::span<const Eigen::Vector3d> points);

/// The unit in which such an extent is one of a LiDAR's. Throws Error where it may be either centimetres or
/// millimetres, with the option that says which.
LengthUnit unit_of_length(const ScanExtent& extent);

/// The unit of a scan after others in `unit`, whose ranges usually have the logarithm `usual` [of metres]: the same,
/// unless it sees about as far as they did in another one, and clearly not in this.
LengthUnit unit_after(LengthUnit unit, double usual, const ScanExtent& extent);

/// "centimetres".
std::string to_text(LengthUnit unit);

}  // namespace tilth
