#include <numbers>

#include <tilth/preprocess/deskew.hpp>
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

}  // namespace

bool is_keyframe(const Pose& T_last_now, const KeyframeOptions& options) {
  return T_last_now.translation().norm() >= options.distance ||
         angle_of(T_last_now) >= options.angle * std::numbers::pi / 180;
}

Keyframe make_keyframe(const OdometryResult& result, double scan_stamp, const KeyframeOptions& options) {
  Keyframe keyframe{.stamp = result.stamp, .T_odometry_lidar = result.T_world_lidar};
  keyframe.patches =
      deskew(thinned(surface_patches(result.filtered, options.patches), std::size_t(options.max_patches)),
             result.motion, result.stamp - scan_stamp);
  keyframe.context = describe_place(result.filtered, options.context);
  return keyframe;
}

}  // namespace tilth
