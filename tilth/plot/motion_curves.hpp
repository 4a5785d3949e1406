// How a trajectory moves, as curves over time: angles, speed, positions. O(n).
#pragma once

#include <string>
#include <vector>

#include <tilth/core/trajectory.hpp>
#include <tilth/plot/plot.hpp>

namespace tilth {

/// [s] of each pose since `start`.
std::vector<float> times_of(const Trajectory& trajectory, double start);

/// [deg] R = Rz(yaw) Ry(pitch) Rx(roll), over [s] since `start`; yaw without jumps of a turn.
struct AngleCurves {
  Curve roll, pitch, yaw;
};
AngleCurves angle_curves(const Trajectory& trajectory, double start, const std::string& name);

/// [m/s] between the pose before and the pose after each pose, over [s] since `start`.
Curve speed_curve(const Trajectory& trajectory, double start, const std::string& name);

/// [m] seen from above: y over x.
Curve path_curve(const Trajectory& trajectory, const std::string& name);

/// [m] height over [s] since `start`.
Curve height_curve(const Trajectory& trajectory, double start, const std::string& name);

}  // namespace tilth
