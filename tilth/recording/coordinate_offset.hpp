// Clouds whose coordinates are not the sensor's but those of a map far away (UTM): how far, and where the sensor is in
// them. O(n).
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include <Eigen/Core>

namespace tilth {

/// About the middle of points that all lie far from (0, 0, 0) beside their spread; nothing where they do not.
std::optional<Eigen::Vector3d> far_offset(std::span<const Eigen::Vector3d> points);

/// Where the beams of a spinning sensor meet: the common apex of the cones about z on which the points of each ring
/// lie. Nothing where they lie on none, or rings are more than 128. `rings` has one entry a point.
std::optional<Eigen::Vector3d> apex_of_rings(std::span<const Eigen::Vector3d> points,
                                             std::span<const std::uint16_t> rings);

}  // namespace tilth
