// Turns: the whole one, and the least one from a direction to another.
#pragma once

#include <numbers>

#include <Eigen/Core>

namespace tilth {

inline constexpr double kTurn = 2 * std::numbers::pi;  ///< [rad]

/// The rotation by the least angle that takes the direction of `from` to that of `to`.
Eigen::Matrix3d least_turn(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

}  // namespace tilth
