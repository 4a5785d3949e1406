// Which body of a vehicle a trajectory gives the poses of: how it moves in its own frame, and poses of another body.
// O(poses).
#pragma once

#include <optional>

#include <tilth/core/trajectory.hpp>

namespace tilth {

/// The unit vector, in the body's own frame, along which it moves: the mean over steps of kForwardStep. Nothing where
/// it moves in no one direction (less than 0.7 of the steps' length add up), or less than ten steps.
std::optional<Eigen::Vector3d> forward_direction(const Trajectory& trajectory);

inline constexpr double kForwardStep = 0.3;  ///< [m]

/// The poses of body b, mounted at T_a_b on the body a whose poses `trajectory` has; its world is turned alike:
/// T_a_b^-1 P T_a_b, so that a start at the origin stays one.
Trajectory in_frame_of(Trajectory trajectory, const Pose& T_a_b);

}  // namespace tilth
