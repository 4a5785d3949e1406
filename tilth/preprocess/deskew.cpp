#include <algorithm>

#include <tilth/core/symmetric3.hpp>
#include <tilth/preprocess/deskew.hpp>

namespace tilth {

SurfacePatches deskew(SurfacePatches patches, const MotionInScan& motion, double reference_time) {
  const auto has_time = [](const SurfacePatch& patch) { return patch.time != 0; };
  if (motion.at_rest() || std::none_of(patches.begin(), patches.end(), has_time)) return patches;
  const ScanMotion moved(motion, reference_time);
  for (SurfacePatch& patch : patches) {
    const Pose T = moved.at(patch.time);
    patch.mean = T * patch.mean;
    patch.normal = T.linear() * patch.normal;
    patch.covariance = rotated(T.linear(), patch.covariance).matrix();
  }
  return patches;
}

PointCloud deskew(PointCloud cloud, const MotionInScan& motion, double reference_time) {
  if (!cloud.has_times() || motion.at_rest()) return cloud;
  const ScanMotion moved(motion, reference_time);
  for (std::size_t i = 0; i < cloud.size(); ++i) cloud.points[i] = moved.move(cloud.points[i], cloud.times[i]);
  return cloud;
}

}  // namespace tilth
