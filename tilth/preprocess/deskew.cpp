#include <algorithm>

#include <tilth/core/rotated_covariance.hpp>
#include <tilth/core/scan_motion.hpp>
#include <tilth/preprocess/deskew.hpp>

namespace tilth {

SurfacePatches deskew(SurfacePatches patches, const Vector6d& velocity, double reference_time,
                      const ScanTremor& tremor) {
  if (patches.empty() || velocity.isZero(0)) return patches;
  const auto earlier = [](const SurfacePatch& a, const SurfacePatch& b) { return a.time < b.time; };
  const float last = std::max_element(patches.begin(), patches.end(), earlier)->time;
  if (last == 0) return patches;  // no times
  const ScanMotion motion(velocity, reference_time, last, tremor);
  for (SurfacePatch& patch : patches) {
    const Pose T = motion.at(patch.time);
    patch.mean = T * patch.mean;
    patch.normal = T.linear() * patch.normal;
    patch.covariance = rotated(T.linear(), patch.covariance);
  }
  return patches;
}

PointCloud deskew(PointCloud cloud, const Vector6d& velocity, double reference_time) {
  if (!cloud.has_times() || velocity.isZero(0)) return cloud;
  const ScanMotion motion(velocity, reference_time, *std::max_element(cloud.times.begin(), cloud.times.end()));
  for (std::size_t i = 0; i < cloud.size(); ++i) cloud.points[i] = motion.move(cloud.points[i], cloud.times[i]);
  return cloud;
}

}  // namespace tilth
