#include <tilth/features/patch_features.hpp>

namespace tilth {
namespace {

SurfacePatches pick(const SurfacePatches& patches, std::span<const std::uint32_t> indices) {
  SurfacePatches picked;
  picked.reserve(indices.size());
  for (const std::uint32_t i : indices) picked.push_back(patches[i]);
  return picked;
}

}  // namespace

PatchFeatures patch_features(const SurfacePatches& patches, const FeatureOptions& options) {
  PointCloud means;
  means.points.reserve(patches.size());
  means.rings.reserve(patches.size());
  std::vector<float> of_flat(patches.size()), of_others(patches.size());  // curvatures; 0: no candidate
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const SurfacePatch& patch = patches[i];
    means.points.push_back(patch.mean);
    means.rings.push_back(patch.ring);
    (patch.flat ? of_flat : of_others)[i] = corrected_curvature(patch.covariance.cast<float>());
  }
  return {pick(patches, select_edges(means, of_others, options)),
          pick(patches, select_planes(means, of_flat, options))};
}

}  // namespace tilth
