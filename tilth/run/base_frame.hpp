// The robot's own frame, base_link: where the LiDAR is mounted on it, and the poses of a run as poses of it. Inside a
// run all poses are the LiDAR's; what is written for others goes through here.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <tilth/core/options.hpp>
#include <tilth/core/trajectory.hpp>

namespace tilth {

/// T_base_lidar of "x,y,z,roll,pitch,yaw" ([m], [deg]; turned about the fixed axes x, y, z in this order, as URDF
/// does), or of "x,y,z,qx,qy,qz,qw", as tf has it. Throws Error naming the number that is missing, none or not finite.
Pose parse_mount(const std::string& text);

/// x y z [m], qx qy qz qw of it.
std::vector<double> mount_numbers(const Pose& T_base_lidar);

/// How summaries and reports tell of it, and of levelling.
std::vector<OptionInfo> describe_mount(const std::string& base_from_lidar, bool level);

/// T_world_base of T_world_lidar; without a mount all stays as it is.
Pose pose_of_base(const Pose& T_world_lidar, const std::optional<Pose>& T_base_lidar);
Trajectory poses_of_base(Trajectory poses, const std::optional<Pose>& T_base_lidar);

/// T_world_lidar of T_world_base.
Trajectory poses_of_lidar(Trajectory poses, const std::optional<Pose>& T_base_lidar);

/// The covariance of that pose in its own frame (right perturbation; Sola, Deray and Atchuthan 2018, equation 55).
Matrix6d covariance_of_base(const Matrix6d& of_lidar, const std::optional<Pose>& T_base_lidar);

/// "base_link", or "lidar" where there is no mount.
std::string body_of(const std::optional<Pose>& T_base_lidar);

}  // namespace tilth
