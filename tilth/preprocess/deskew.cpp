#include <algorithm>

#include <tilth/core/rotated_covariance.hpp>
#include <tilth/preprocess/deskew.hpp>

namespace tilth {

SurfacePatches deskew(SurfacePatches patches, const MotionInScan& motion, double reference_time) {
  if (patches.empty() || motion.at_rest()) return patches;
  const auto earlier = [](const SurfacePatch& a, const SurfacePatch& b) { return a.time < b.time; };
  const float last = std::max_element(patches.begin(), patches.end(), earlier)->time;
  if (last == 0) return patches;  // no times
  const ScanMotion moved(motion, reference_time, last);
  for (SurfacePatch& patch : patches) {
    const Pose T = moved.at(patch.time);
    patch.mean = T * patch.mean;
    patch.normal = T.linear() * patch.normal;
    patch.covariance = rotated(T.linear(), patch.covariance);
  }
  return patches;
}

PointCloud deskew(PointCloud cloud, const MotionInScan& motion, double reference_time) {
  if (!cloud.has_times() || motion.at_rest()) return cloud;
  const ScanMotion moved(motion, reference_time, *std::max_element(cloud.times.begin(), cloud.times.end()));
  for (std::size_t i = 0; i < cloud.size(); ++i) cloud.points[i] = moved.move(cloud.points[i], cloud.times[i]);
  return cloud;
}

}  // namespace tilth
