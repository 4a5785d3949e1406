// Patches of neighbouring keyframes in one frame, and the registration of one such submap to another: GICP on surfaces
// of voxels (Koide et al. 2021), coarse to fine, under a robust kernel that narrows. A few milliseconds a registration.
#pragma once

#include <tilth/core/options.hpp>
#include <tilth/core/surface_patch.hpp>
#include <tilth/map/patch_map.hpp>
#include <tilth/registration/align.hpp>

namespace tilth {

struct SubmapOptions {
  double coarse_voxel = 2.0;
  double fine_voxel = 0.5;
  double first_kernel_width = 10.0;
  double kernel_width = 2.0;
  int max_iterations = 30;
  double patch_variance = 2e-4;
  double min_cosine = 0.8;
  double same_distance = 0.1;
  double range = 30.0;
};

template <class V>
void visit(SubmapOptions& o, V&& v) {
  v("coarse_voxel", o.coarse_voxel, Bounds{0.05, 100}, "[m] of the surfaces that a registration begins with");
  v("fine_voxel", o.fine_voxel, Bounds{0.05, 100}, "[m] of the surfaces that it ends with");
  v("first_kernel_width", o.first_kernel_width, Bounds{1e-3, 1e9},
    "[sigma] at which the Geman-McClure kernel begins to act at first");
  v("kernel_width", o.kernel_width, Bounds{1e-3, 1e9}, "[sigma] the same at the end");
  v("max_iterations", o.max_iterations, Bounds{1, 10000}, "[-] of each step from coarse to fine");
  v("patch_variance", o.patch_variance, Bounds{1e-12, 1}, "[m^2] added to the variance of every pair");
  v("min_cosine", o.min_cosine, Bounds{-1, 1}, "[-] between the normals of a pair");
  v("same_distance", o.same_distance, Bounds{1e-3, 10}, "[m] from a surface within which a patch lies on it");
  v("range", o.range, Bounds{1, 1e4}, "[m] patches farther from the sensor do not count in the overlap");
}

/// What a submap is registered to: its patches, and its surfaces by coarse and by fine voxels.
class Submap {
 public:
  Submap(SurfacePatches patches, const SubmapOptions& options);

  const SurfacePatches& patches() const { return patches_; }
  const PatchMap& coarse() const { return coarse_; }
  const PatchMap& fine() const { return fine_; }

 private:
  SurfacePatches patches_;
  PatchMap coarse_, fine_;
};

/// T_init refined by the coarse surfaces, then by the fine ones. Not converged: T_target_source is what was left.
AlignResult register_submap(const SurfacePatches& source, const Submap& target, const Pose& T_init,
                            const SubmapOptions& options);

/// The last steps of it: fine surfaces and narrow kernel alone.
AlignResult refine(const SurfacePatches& source, const Submap& target, const Pose& T_init,
                   const SubmapOptions& options);

/// [m] from the surface of `target` that each patch lies on, in their order; infinite where it lies on none.
std::vector<float> distances_on(const SurfacePatches& source, const Pose& T_target_source, const PatchMap& target,
                                const SubmapOptions& options);

/// How far two submaps tell of the same surfaces.
struct Overlap {
  double ratio = 0.0;      ///< of the patches within range that lie on a surface of the other submap
  double landmarks = 0.0;  ///< the same of those that face along an axis, or are not flat
  double fitness = 0.0;    ///< [m] root mean square distance from these surfaces
};

/// `axis`, in the source's frame, says what landmarks are: walls along which a corridor leads are none.
Overlap overlap_of(const SurfacePatches& source, const Pose& T_target_source, const PatchMap& target,
                   const Eigen::Vector3d& axis, const SubmapOptions& options);

/// `patches` moved by T_target_source.
SurfacePatches moved(SurfacePatches patches, const Pose& T_target_source);

}  // namespace tilth
