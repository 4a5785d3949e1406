// Whether the map stands level: the floor below the first seconds of a run.
#pragma once

#include <span>
#include <string>

#include <tilth/core/scan.hpp>
#include <tilth/freespace/floor_plane.hpp>
#include <tilth/odometry/odometry.hpp>

namespace tilth {

/// The floor that `scans` show, registered by `odometry` (which nothing else is asked of), in the frame that begins as
/// the robot's base, or as the LiDAR with T_base_lidar = identity. Throws Error where they show none.
FloorPlane floor_below(Odometry& odometry, std::span<const Scan> scans, const Pose& T_base_lidar);

/// "the floor lies 1.73 m below the LiDAR and was tilted by 2.31 deg, its 5210 points 12 mm about it"
std::string floor_sentence(const FloorPlane& floor);

}  // namespace tilth
