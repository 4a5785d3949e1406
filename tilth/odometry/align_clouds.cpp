#include <algorithm>

#include <tilth/odometry/align_clouds.hpp>

namespace tilth {
namespace {

AlignResult align_step(MatchedPatches<MapSurface>& source, const PatchMap& target, const Pose& T_init,
                       double max_distance, const AlignCloudsOptions& options) {
  const AssociationOptions association{.max_distance = max_distance, .lambda = options.lambda, .renew_distance = 0};
  return align(T_init, options.align,
               [&](const Pose& T) { return associate_distributions(source, T, target, association); });
}

}  // namespace

AlignResult align_clouds(const PointCloud& source, const PointCloud& target, const Pose& T_init,
                         const AlignCloudsOptions& options) {
  MatchedPatches<MapSurface> patches{surface_patches(source, options.patches)};
  const SurfacePatches target_patches = surface_patches(target, options.patches);
  AlignResult result{.T_target_source = T_init};
  double voxel_size = std::max(options.coarse_voxel, options.map.voxel_size);
  for (bool last = false; !last; voxel_size = std::max(0.5 * voxel_size, options.map.voxel_size)) {
    last = voxel_size == options.map.voxel_size;
    PatchMapOptions map_options = options.map;
    map_options.voxel_size = voxel_size;
    PatchMap map(map_options);
    map.insert(target_patches, Pose::Identity());
    patches.matches.clear();
    result = align_step(patches, map, result.T_target_source, voxel_size, options);
    if (result.matches < std::size_t(options.align.min_matches)) break;
  }
  if (!result.converged) result.T_target_source = T_init;
  result.candidates = patches.patches.size();
  return result;
}

}  // namespace tilth
