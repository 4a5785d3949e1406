// How the sensor travels: a list of legs with a speed and a turn each, joined so that speed and yaw rate have
// continuous derivatives, plus what a wheeled platform adds: smooth roll, pitch and weave while it moves, and
// vibration.
#pragma once

#include <cstdint>
#include <span>

#include <tilth/core/trajectory.hpp>

namespace tilth {

/// A stretch of travel. The speed passes over to `speed` in the first `blend` seconds; the yaw turns all along.
struct Leg {
  double duration = 1.0;  ///< [s]
  double speed = 0.0;     ///< [m/s] along x; negative: in reverse
  double turn = 0.0;      ///< [rad] to the left
};

struct MotionOptions {
  double speed_scale = 1.0;      ///< [-] the same way driven this many times as fast
  double wobble = 0.02;          ///< [rad] bound of roll and of pitch
  double weave = 0.02;           ///< [rad] bound of the heading's swing about the way
  double vibration = 0.0;        ///< [m] deviation of each coordinate
  double vibration_angle = 0.0;  ///< [rad] deviation about each axis
  std::uint64_t seed = 1;
};

inline constexpr double kTruthRate = 200;  ///< [Hz] of the poses that define the motion; between them a screw motion
inline constexpr double kLongestDrive = 36000;  ///< [s]

/// The pose with the vibration of `time` [s] added.
Pose shaken(const Pose& T_world_lidar, double time, const MotionOptions& options);

/// The poses at 200 Hz from time 0 to the end of the last leg, the first one at T_world_start.
Trajectory drive(std::span<const Leg> legs, const Pose& T_world_start, const MotionOptions& options);

/// [s] that `legs` take.
double duration_of(std::span<const Leg> legs, const MotionOptions& options);

}  // namespace tilth
