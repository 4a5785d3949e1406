// A scan that is kept for loop closure: its patches of surface, what its place looks like, and where odometry put it.
#pragma once

#include <tilth/core/options.hpp>
#include <tilth/core/surface_patch.hpp>
#include <tilth/features/surface_patches.hpp>
#include <tilth/odometry/odometry.hpp>
#include <tilth/slam/scan_context.hpp>

namespace tilth {

struct KeyframeOptions {
  double distance = 1.0;
  double angle = 30.0;
  int max_patches = 1200;
  double beam_spacing = 1.25;
  PatchOptions patches;
  ScanContextOptions context;
};

template <class V>
void visit(KeyframeOptions& o, V&& v) {
  v("distance", o.distance, Bounds{0.01, 1000}, "[m] travelled since the last keyframe makes a new one");
  v("angle", o.angle, Bounds{0.1, 180}, "[deg] turned since the last keyframe makes a new one");
  v("max_patches", o.max_patches, Bounds{50, 1e6}, "[patches] kept of a keyframe at most, evenly over the scan",
    kAdvanced);
  v("beam_spacing", o.beam_spacing, Bounds{0, 90}, "[deg] of elevation between the beams that are used, at least",
    kAdvanced);
  v("patches", o.patches, "[-] patches of surface", kAdvanced);
  v("context", o.context, "[-] descriptor of a place", kAdvanced);
}

struct Keyframe {
  std::size_t scan = 0;  ///< number among the registered scans
  double stamp = 0.0;    ///< [s]
  double path = 0.0;     ///< [m] travelled up to here
  bool severed = false;  ///< the motion since the keyframe before is not known: the track was lost in between
  Pose T_odometry_lidar = Pose::Identity();    ///< by odometry alone
  Matrix6d covariance = Matrix6d::Identity();  ///< [rad^2, m^2] of the motion since the keyframe before
  SurfacePatches patches = {};                 ///< in the LiDAR frame at `stamp`
  ScanContext context = {};
};

/// Whether `T_last_now` is far enough from the last keyframe.
bool is_keyframe(const Pose& T_last_now, const KeyframeOptions& options);

/// The patches of a registered scan, undistorted, in the LiDAR frame at its stamp; `scan_stamp` [s] is its first
/// point's.
SurfacePatches keyframe_patches(const OdometryResult& result, double scan_stamp, const KeyframeOptions& options);

/// The patches and the descriptor of a registered scan. The rest of the keyframe is for the caller to fill in.
Keyframe make_keyframe(const OdometryResult& result, double scan_stamp, const KeyframeOptions& options);

}  // namespace tilth
