#include <tilth/core/voxel_table.hpp>
#include <tilth/localization/gone_surfaces.hpp>

namespace tilth {

std::int64_t GoneSurfaces::key_of(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const {
  int axis;
  normal.cwiseAbs().maxCoeff(&axis);
  return voxel_key(voxel_of(point / options_.submap.fine_voxel), 2 * axis + (normal[axis] > 0));
}

void GoneSurfaces::look(const SurfacePatches& patches, const Pose& T_map_lidar, const PatchMap& map) {
  ++looks_;
  for_each_passed(patches, map, T_map_lidar, options_, [&](const MapSurface& surface) {
    Passed& passed = passed_[key_of(surface.mean, surface.normal)];
    if (passed.last == looks_) return;
    passed.last = looks_;
    ++passed.looks;
  });
}

bool GoneSurfaces::holds(const SurfacePatch& patch_in_map) const {
  constexpr int kLooks = 3;
  if (!patch_in_map.flat) return false;
  const auto passed = passed_.find(key_of(patch_in_map.mean, patch_in_map.normal));
  return passed != passed_.end() && passed->second.looks >= kLooks;
}

}  // namespace tilth
