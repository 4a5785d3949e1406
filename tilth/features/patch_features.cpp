#include <tilth/features/patch_features.hpp>

namespace tilth {
namespace {

SurfacePatches pick(const SurfacePatches& patches, std::span<const std::uint32_t> indices) {
  SurfacePatches picked;
  picked.reserve(indices.size());
  for (const std::uint32_t i : indices) picked.push_back(patches[i]);
  return picked;
}

// kappa of every patch that is flat, or of every one that is not; 0 for the others.
std::vector<float> curvatures(const SurfacePatches& patches, bool flat) {
  std::vector<float> kappa(patches.size());
  for (std::size_t i = 0; i < kappa.size(); ++i) {
    if (patches[i].flat == flat) kappa[i] = corrected_curvature(patches[i].covariance.cast<float>());
  }
  return kappa;
}

}  // namespace

PatchFeatures patch_features(const SurfacePatches& patches, const FeatureOptions& options) {
  PointCloud means;
  for (const SurfacePatch& patch : patches) {
    means.points.push_back(patch.mean);
    means.rings.push_back(patch.ring);
  }
  return {pick(patches, select_edges(means, curvatures(patches, false), options)),
          pick(patches, select_planes(means, curvatures(patches, true), options))};
}

}  // namespace tilth
