// Two clouds registered to one another: GICP (Segal et al. 2009) of the patches of one with voxels of the other (Koide
// et al. 2021), from large voxels to small ones. A few milliseconds for two scans of 28,000 points.
#pragma once

#include <tilth/core/options.hpp>
#include <tilth/core/point_cloud.hpp>
#include <tilth/features/surface_patches.hpp>
#include <tilth/map/patch_map.hpp>
#include <tilth/registration/align.hpp>
#include <tilth/registration/association.hpp>

namespace tilth {

struct AlignCloudsOptions {
  double coarse_voxel = 2.0;
  PatchOptions patches;
  PatchMapOptions map;
  AlignOptions align{.max_iterations = 50, .kernel = Kernel::geman_mcclure, .kernel_width = 4.0};
  double lambda = 1e-4;
};

template <class V>
void visit(AlignCloudsOptions& o, V&& v) {
  v("coarse_voxel", o.coarse_voxel, Bounds{0.05, 100},
    "[m] voxels, and distance of a match, of the first step; halved from step to step down to those of `map`");
  v("patches", o.patches, "[-] patches of surface of either cloud");
  v("map", o.map, "[-] surfaces of the target, in the last step");
  v("align", o.align, "[-] each step");
  v("lambda", o.lambda, Bounds{1e-12, 1}, "[m^2] added to the diagonal of every covariance");
}

/// T_target_source, by which `transform(source, T)` lies on `target`, found from `T_init` on: within about coarse_voxel
/// and 20 degrees of it. `converged` is false where there was too little to match; then T_init comes back. Each cloud
/// counts as measured at once (deskew() it before) from the origin of its frame.
AlignResult align_clouds(const PointCloud& source, const PointCloud& target, const Pose& T_init = Pose::Identity(),
                         const AlignCloudsOptions& options = {});

}  // namespace tilth
