// Edge and plane features among the patches of a scan, by the corrected curvature of their covariances (Fu et al. 2026,
// section 2.3): edges among those that are not flat, planes among those that are. O(patches).
#pragma once

#include <tilth/core/surface_patch.hpp>
#include <tilth/features/edge_plane.hpp>

namespace tilth {

struct PatchFeatures {
  SurfacePatches edges, planes;
};

PatchFeatures patch_features(const SurfacePatches& patches, const FeatureOptions& options);

}  // namespace tilth
