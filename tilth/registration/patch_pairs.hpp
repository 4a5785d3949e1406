// Patches of a scan in motion and the surfaces that they are held against: found anew as the pose and the velocity
// change. O(patches) look-ups.
#pragma once

#include <vector>

#include <tilth/core/scan_motion.hpp>
#include <tilth/core/surface_patch.hpp>
#include <tilth/registration/association.hpp>
#include <tilth/registration/continuous_time_options.hpp>

namespace tilth {

/// A patch and the plane that it is held against (point to plane), seen from the LiDAR in the middle of the scan.
struct FlatPair {
  Eigen::Vector3d point;   ///< [m] of the patch
  Eigen::Vector3d normal;  ///< unit, of the surface
  double residual;         ///< [m] of the point from the surface, along its normal
  double information;      ///< [1/m^2] of the residual
  double lever;            ///< [s] from the middle of the scan to the patch: how far the velocity moves it
};

/// A patch and a surface that is no plane, likewise, with the offset and its covariance in the map's frame: its
/// residual is their Mahalanobis distance (docs/method.md, 6).
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
  Pose T_map_lidar = Pose::Identity();  ///< at `middle`
  MotionInScan motion = {};             ///< about `middle`
  double middle = 0.0;                  ///< [s] since the stamp of the scan
  double kernel_width = 1.0;            ///< [sigma] in force
};

template <class Surface>
struct PatchMatching {
  std::vector<SurfaceMatch<Surface>> matches;  ///< one a patch
  PatchPairs pairs;                            ///< those near enough, and facing the same way
};

/// Variance of the point-to-plane residual (docs/method.md, 5) [m^2] along `n`, the surface's normal seen from the
/// patch: that of the mean of the patch's points,
/// part of their spread, which is wide where the two do not face the same way, and that of the surface, less as it has
/// more patches.
template <class Surface>
double pair_variance(const SurfacePatch& patch, const Eigen::Vector3d& n, const Surface& surface,
                     const ContinuousTimeOptions& options) {
  return double(patch.thickness) / double(patch.points) + options.spread_ratio * n.dot(patch.covariance * n) +
         (options.surface_ratio + options.surface_doubt / double(surface.patches)) * surface.variance +
         options.patch_variance;
}

/// Brings `matching`, of the iteration before, up to date at `state`.
template <SurfaceMap Map>
void associate_patches(const SurfacePatches& patches, const MotionState& state, const Map& map,
                       const ContinuousTimeOptions& options, PatchMatching<SurfaceOf<Map>>& matching) {
  matching.matches.resize(patches.size());
  matching.pairs.clear();
  const double max_squared = options.max_distance * options.max_distance;
  const double renew_squared = options.renew_distance * options.renew_distance;
  const ScanMotion motion(state.motion, state.middle);
  const Eigen::Matrix3d R_map_lidar = state.T_map_lidar.linear(), R_lidar_map = R_map_lidar.transpose();
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const SurfacePatch& patch = patches[i];
    const double lever = double(patch.time) - state.middle;
    const Eigen::Vector3d point = motion.move(patch.mean, patch.time), point_in_map = state.T_map_lidar * point;
    const Eigen::Matrix3d R_lidar_patch = motion.rotation(patch.time);
    const auto look_up = [&] {
      return map.find(point_in_map, R_map_lidar * (R_lidar_patch * patch.normal), patch.flat);
    };
    const SurfaceOf<Map>* surface = surface_at(point_in_map, renew_squared, matching.matches[i], look_up);
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

}  // namespace tilth
