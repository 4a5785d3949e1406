// The front door: everything that registering scans takes. A scan and its cloud, poses and trajectories, the pipelines
// by name and their options, two clouds aligned, a trajectory judged; loop closure where it was built.
#pragma once

#include <tilth/core/error.hpp>
#include <tilth/core/options.hpp>
#include <tilth/core/point_cloud.hpp>
#include <tilth/core/scan.hpp>
#include <tilth/core/se3.hpp>
#include <tilth/core/trajectory.hpp>
#include <tilth/evaluation/evaluate.hpp>
#include <tilth/odometry/align_clouds.hpp>
#include <tilth/odometry/make_odometry.hpp>
#include <tilth/odometry/odometry.hpp>
#if __has_include(<tilth/slam/slam.hpp>)
#include <tilth/slam/slam.hpp>
#endif
