// A way of the user's own for the sensor: through way-points at a speed, or along poses with times. Both give poses at
// 200 Hz from time 0 with continuous velocity. O(poses).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <tilth/core/options.hpp>
#include <tilth/simulation/motion.hpp>

namespace tilth {

struct PathOptions {
  std::string path;        ///< TUM file of poses with times; empty: none
  std::string waypoints;   ///< "x,y[,z];x,y[,z];..."; empty: none
  double cruise = 0.5;     ///< [m/s] through way-points
  double corner = 0.8;     ///< [m] before and after a way-point, over which the way turns
  std::string model_path;  ///< folders of models for a world file, with ':' between them
};

template <class V>
void visit(PathOptions& o, V&& v) {
  v("path", o.path, "[-] TUM file of the sensor's poses with their times, instead of the scene's own way");
  v("waypoints", o.waypoints, "[m] x,y[,z];x,y[,z];... to drive through, instead of the scene's own way; no z: height");
  v("cruise", o.cruise, Bounds{0.01, 50}, "[m/s] of the drive through way-points");
  v("corner", o.corner, Bounds{0.01, 20}, "[m] before and after a way-point, over which the drive turns");
  v("model_path", o.model_path, "[-] folders with the models and meshes that a world file names, ':' between them");
}

/// What "x,y[,z];x,y[,z]" says, with `height` [m] where a z is missing. Throws Error naming the way-point that is none,
/// and where there are fewer than two.
std::vector<Eigen::Vector3d> parse_waypoints(std::string_view text, double height);

/// A drive from rest to rest through the way-points, level, its heading that of the way. Corners are cut: the drive
/// leaves the straight way `corner` before a way-point and is back on it as far behind, or half a leg where that is
/// shorter. Throws Error where two way-points that follow one another are the same.
Trajectory drive_through(const std::vector<Eigen::Vector3d>& waypoints, const PathOptions& path,
                         const MotionOptions& motion);

/// Through every pose at its time, counted from the first one's, with continuous velocity and turn rate (cubic Hermite
/// in the position, cumulative cubic Bezier in the rotation: M.-J. Kim, M.-S. Kim, S. Y. Shin, SIGGRAPH 1995). Throws
/// Error on fewer than two poses and on stamps that do not ascend strictly.
Trajectory follow(const Trajectory& poses, const MotionOptions& motion);

}  // namespace tilth
