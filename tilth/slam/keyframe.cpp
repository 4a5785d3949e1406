#include <numbers>

#include <tilth/core/symmetric3.hpp>
#include <tilth/preprocess/deskew.hpp>
#include <tilth/preprocess/sparse_beams.hpp>
#include <tilth/slam/keyframe.hpp>

namespace tilth {
namespace {

SurfacePatches thinned(SurfacePatches patches, std::size_t most) {
  const std::size_t all = patches.size();
  if (all <= most) return patches;
  for (std::size_t i = 0; i < most; ++i) patches[i] = patches[i * all / most];
  patches.resize(most);
  patches.shrink_to_fit();
  return patches;
}

/// The patches of a scan without outliers, in the frame of its cloud.
SurfacePatches patches_of(const OdometryResult& result, const KeyframeOptions& options) {
  const auto patches_in = [&](PointCloud cloud) {
    return surface_patches(sparse_beams(std::move(cloud), options.beam_spacing), options.patches);
  };
  if (!result.T_lidar_sensor) return patches_in(result.filtered);
  const Pose& T_lidar_sensor = *result.T_lidar_sensor;
  SurfacePatches patches = patches_in(transform(result.filtered, T_lidar_sensor.inverse()));
  for (SurfacePatch& patch : patches) {
    patch.mean = T_lidar_sensor * patch.mean;
    patch.covariance = rotated(T_lidar_sensor.linear(), patch.covariance).matrix();
    patch.normal = T_lidar_sensor.linear() * patch.normal;
  }
  return patches;
}

}  // namespace

bool is_keyframe(const Pose& T_last_now, const KeyframeOptions& options) {
  return T_last_now.translation().norm() >= options.distance ||
         angle_of(T_last_now) >= options.angle * std::numbers::pi / 180;
}

SurfacePatches keyframe_patches(const OdometryResult& result, double scan_stamp, const KeyframeOptions& options) {
  return deskew(thinned(patches_of(result, options), std::size_t(options.max_patches)), result.motion,
                result.stamp - scan_stamp);
}

Keyframe make_keyframe(const OdometryResult& result, double scan_stamp, const KeyframeOptions& options) {
  Keyframe keyframe{.stamp = result.stamp, .T_odometry_lidar = result.T_world_lidar};
  keyframe.patches = keyframe_patches(result, scan_stamp, options);
  keyframe.context = describe_place(result.filtered, options.context);
  return keyframe;
}

}  // namespace tilth
