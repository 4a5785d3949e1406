// Registration of a scan that was taken in motion: the pose in the middle of the scan and the velocity during it are
// estimated together, so that the scan is straightened by its own motion and not by that of the scan before.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include <tilth/core/scan_motion.hpp>
#include <tilth/core/scan_tremor.hpp>
#include <tilth/core/surface_patch.hpp>
#include <tilth/registration/align_moving_options.hpp>
#include <tilth/registration/align_result.hpp>
#include <tilth/registration/association.hpp>

namespace tilth {

/// What is known before the scan. Instants are the middles of scans.
struct MotionPrior {
  Pose T_map_last = Pose::Identity();           ///< the last pose
  Vector6d velocity = Vector6d::Zero();         ///< [rad/s, m/s] expected, in the LiDAR's frame
  Vector6d last_motion = Vector6d::Zero();      ///< [rad/s, m/s] mean velocity between the last two poses
  Vector6d steady_velocity = Vector6d::Zero();  ///< [rad/s, m/s] mean of about the last second
  double interval = 0.0;                        ///< [s] since the last pose; > 0
  TremorEvidence tremor = {};                   ///< of about the last two seconds
  ScanTremor tremor_mean = {};                  ///< of about the last fifteen seconds
  bool known = false;                           ///< false: nothing is known of the motion yet, only that it is steady
};

/// Where the velocity expected leads to.
inline Pose predicted(const MotionPrior& prior) {
  return retract(prior.T_map_last, prior.velocity * prior.interval);
}

struct MovingAlignment {
  AlignResult pose;                      ///< T_target_source is at `middle`
  Vector6d velocity = Vector6d::Zero();  ///< [rad/s, m/s] during the scan, in the LiDAR's frame
  ScanTremor tremor = {};                ///< beside that velocity
  TremorEvidence evidence = {};          ///< on the spread of tremors
  /// [rad^2, m^2] of the pose at `middle` (right perturbation) if the surfaces were exact, with velocity and tremor
  /// unknown; of the prior, from the last pose on, where the pairs gave none
  Matrix6d covariance = Matrix6d::Zero();
  /// * x is the part of a motion x of the pose that the surfaces say nothing about: there the motion goes on as it was
  Matrix6d dead_reckoned = Matrix6d::Zero();
  std::optional<double> surfaces_seen_at = {};  ///< [s] mean time of the surfaces' patches; none without a pose
};

/// What is known after a scan, for the next one; `interval` is still to be set.
MotionPrior next(const MotionPrior& prior, const MovingAlignment& alignment);

/// A patch and the plane that it is held against, seen from the LiDAR in the middle of the scan.
struct FlatPair {
  Eigen::Vector3d point;   ///< [m] of the patch
  Eigen::Vector3d normal;  ///< unit, of the surface
  double residual;         ///< [m] of the point from the surface, along its normal
  double information;      ///< [1/m^2] of the residual
  double lever;            ///< [s] from the middle of the scan to the patch: how far the velocity moves it
};

/// A patch and a surface that is no plane, likewise, with the offset and its covariance in the map's frame.
struct ShapePair {
  Eigen::Vector3d point;          ///< [m] in the LiDAR's frame
  Eigen::Vector3d offset_in_map;  ///< [m] from the surface's mean
  Eigen::Matrix3d joint_in_map;   ///< [m^2] covariance of both
  double lever;                   ///< [s]
};

struct PatchPairs {
  std::vector<FlatPair> flat;
  std::vector<ShapePair> shapes;
  double seen_at_sum = 0.0;  ///< [s] over the surfaces

  std::size_t size() const { return flat.size() + shapes.size(); }
  void clear() {
    flat.clear();
    shapes.clear();
    seen_at_sum = 0.0;
  }
};

/// The state that is estimated.
struct MotionState {
  Pose T_map_lidar = Pose::Identity();   ///< at `middle`
  Vector6d velocity = Vector6d::Zero();  ///< [rad/s, m/s]
  double middle = 0.0;                   ///< [s] since the stamp of the scan
  double kernel_width = 1.0;             ///< [sigma] in force
  ScanTremor tremor = {};                ///< beside the velocity
};

struct PatchMatching {
  std::vector<SurfaceMatch> matches;  ///< one a patch
  PatchPairs pairs;                   ///< those near enough, and facing the same way
};

/// [rad^2, m^2] of the pose predicted: by the accelerations that a robot is capable of.
Vector6d pose_variances(const MotionPrior& prior, const AlignMovingOptions& options);

/// [m^2] of a residual along `n`, the surface's normal seen from the patch: that of the mean of the patch's points,
/// part of their spread, which is wide where the two do not face the same way, and that of the surface, less as it has
/// more patches.
template <class Surface>
double pair_variance(const SurfacePatch& patch, const Eigen::Vector3d& n, const Surface& surface,
                     const AlignMovingOptions& options) {
  return double(patch.thickness) / double(patch.points) + options.spread_share * n.dot(patch.covariance * n) +
         (options.surface_share + options.surface_doubt / double(surface.patches)) * surface.variance +
         options.patch_variance;
}

/// Brings `matching`, of the iteration before, up to date at `state`.
template <SurfaceLookup Lookup>
void associate_patches(const SurfacePatches& patches, const MotionState& state, const Lookup& target,
                       const AlignMovingOptions& options, PatchMatching& matching) {
  matching.matches.resize(patches.size());
  matching.pairs.clear();
  const double max_squared = options.max_distance * options.max_distance;
  const double renew_squared = options.renew_distance * options.renew_distance;
  const ScanMotion motion(state.velocity, state.middle, 2 * state.middle, state.tremor);
  const Eigen::Matrix3d R_map_lidar = state.T_map_lidar.linear(), R_lidar_map = R_map_lidar.transpose();
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const SurfacePatch& patch = patches[i];
    const double lever = double(patch.time) - state.middle;
    const Eigen::Vector3d point = motion.move(patch.mean, patch.time), point_in_map = state.T_map_lidar * point;
    const Eigen::Matrix3d& R_lidar_patch = motion.rotation(patch.time);
    const auto look_up = [&] { return target(point_in_map, R_map_lidar * (R_lidar_patch * patch.normal), patch.flat); };
    const auto* surface = surface_at(point_in_map, renew_squared, matching.matches[i], look_up);
    if (surface == nullptr) continue;
    const Eigen::Vector3d offset = point_in_map - surface->mean;
    if (offset.squaredNorm() > max_squared) continue;
    if (surface->planar) {
      const Eigen::Vector3d normal = R_lidar_map * surface->normal, n = R_lidar_patch.transpose() * normal;
      if (patch.flat && n.dot(patch.normal) < options.min_cosine) continue;
      const double information = 1 / pair_variance(patch, n, *surface, options);
      matching.pairs.flat.push_back({point, normal, surface->normal.dot(offset), information, lever});
    } else {
      const Eigen::Matrix3d R = R_map_lidar * R_lidar_patch;
      Eigen::Matrix3d joint = R * patch.covariance * R.transpose() + surface->covariance;
      joint.diagonal().array() += options.patch_variance;
      matching.pairs.shapes.push_back({point, offset, joint, lever});
    }
    matching.pairs.seen_at_sum += surface->seen_at;
  }
}

/// One step of `state` on `pairs` and the prior, with the diagnosis of the pairs; false where there are too few pairs
/// or no solution.
bool step_moving(const PatchPairs& pairs, const MotionPrior& prior, const AlignMovingOptions& options,
                 MotionState& state, MovingAlignment& result);

/// The state at which the patches agree with the target, and the prior. Pairs are made anew in every iteration; the
/// kernel narrows from first_kernel_width to kernel_width (graduated non-convexity, Yang et al. 2020). Too few pairs:
/// the predicted pose comes back, not converged.
template <SurfaceLookup Lookup>
MovingAlignment align_moving(const SurfacePatches& patches, double middle, const MotionPrior& prior,
                             const Lookup& target, const AlignMovingOptions& options) {
  MotionState state{predicted(prior), prior.velocity, middle,
                    std::max(options.first_kernel_width, options.kernel_width)};
  MovingAlignment result{.pose = {.T_target_source = state.T_map_lidar},
                         .velocity = state.velocity,
                         .covariance = pose_variances(prior, options).asDiagonal()};
  result.pose.candidates = patches.size();
  PatchMatching matching;
  while (result.pose.iterations < options.max_iterations && !result.pose.converged) {
    associate_patches(patches, state, target, options, matching);
    if (!step_moving(matching.pairs, prior, options, state, result)) return result;
    result.pose.converged &= state.kernel_width <= options.kernel_width;
    state.kernel_width = std::max(options.kernel_width, state.kernel_width / 2);
  }
  result.pose.T_target_source = state.T_map_lidar;
  result.velocity = state.velocity;
  result.tremor = state.tremor;
  return result;
}

}  // namespace tilth
