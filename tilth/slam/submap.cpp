#include <cmath>
#include <limits>
#include <optional>

#include <tilth/registration/association.hpp>
#include <tilth/slam/submap.hpp>

namespace tilth {
namespace {

PatchMap map_of(const SurfacePatches& patches, double voxel_size) {
  PatchMapOptions options;
  options.voxel_size = voxel_size;
  PatchMap map(options);
  map.insert(patches, Pose::Identity());
  return map;
}

struct Target {
  const PatchMap& map;
  double voxel_size;
};

// The pairs of one association: flat patches are held along the normal of their surface alone.
class SubmapPairs {
  AssociationOptions reach() const {
    return {.max_distance = target_.voxel_size, .lambda = 0.5 * options_.patch_variance, .renew_distance = 0};
  }

 public:
  SubmapPairs(const SurfacePatches& source, const Target& target, const SubmapOptions& options)
      : target_(target), options_(options) {
    for (const SurfacePatch& patch : source) (patch.flat ? flat_ : others_).patches.push_back(patch);
  }

  std::vector<PointToPlane> planes(const Pose& T) {
    std::vector<PointToPlane> pairs;
    pairs.reserve(flat_.patches.size());
    for_each_match(flat_, T, target_.map, reach(), [&](const SurfacePatch& patch, const MapSurface& surface) {
      if ((T.linear() * patch.normal).dot(surface.normal) < options_.min_cosine) return;
      const double variance = double(patch.thickness) + surface.variance + options_.patch_variance;
      pairs.push_back({patch.mean, surface.mean, surface.normal / std::sqrt(variance)});
    });
    return pairs;
  }

  std::vector<DistributionToDistribution> shapes(const Pose& T) {
    return associate_distributions(others_, T, target_.map, reach());
  }

 private:
  MatchedPatches<MapSurface> flat_, others_;
  Target target_;
  const SubmapOptions& options_;
};

AlignResult align_to(SubmapPairs& pairs, const Pose& T_init, double kernel_width, const SubmapOptions& options) {
  AlignOptions align_options;
  align_options.max_iterations = options.max_iterations;
  align_options.transformation_epsilon = 1e-4;
  align_options.fitness_epsilon = 0;
  align_options.kernel = Kernel::geman_mcclure;
  align_options.kernel_width = kernel_width;
  return align(
      T_init, align_options, [&](const Pose& T) { return pairs.planes(T); },
      [&](const Pose& T) { return pairs.shapes(T); });
}

// [m] from the surface, or nothing where the patch does not lie on it.
std::optional<double> distance_on(const MapSurface* surface, const SurfacePatch& patch, const Pose& T_target_source,
                                  const SubmapOptions& options) {
  if (surface == nullptr) return std::nullopt;
  const Eigen::Vector3d offset = T_target_source * patch.mean - surface->mean;
  if (!patch.flat) return offset.norm() > 2 * options.same_distance ? std::nullopt : std::optional(offset.norm() / 2);
  const double distance = std::abs(surface->normal.dot(offset));
  const bool alike = (T_target_source.linear() * patch.normal).dot(surface->normal) >= options.min_cosine;
  return alike && distance <= options.same_distance ? std::optional(distance) : std::nullopt;
}

}  // namespace

Submap::Submap(SurfacePatches patches, const SubmapOptions& options)
    : patches_(std::move(patches)),
      coarse_(map_of(patches_, options.coarse_voxel)),
      fine_(map_of(patches_, options.fine_voxel)) {}

AlignResult refine(const SurfacePatches& source, const Submap& target, const Pose& T_init,
                   const SubmapOptions& options) {
  SubmapPairs pairs(source, {target.fine(), options.fine_voxel}, options);
  AlignResult result{.T_target_source = T_init};
  const double first_width = 4 * options.kernel_width;
  for (double width = first_width; width > 0.99 * options.kernel_width; width /= 2)
    result = align_to(pairs, result.T_target_source, width, options);
  result.candidates = source.size();
  return result;
}

AlignResult register_submap(const SurfacePatches& source, const Submap& target, const Pose& T_init,
                            const SubmapOptions& options) {
  SubmapPairs pairs(source, {target.coarse(), options.coarse_voxel}, options);
  const AlignResult coarse = align_to(pairs, T_init, options.first_kernel_width, options);
  return refine(source, target, coarse.T_target_source, options);
}

std::vector<float> distances_on(const SurfacePatches& source, const Pose& T_target_source, const PatchMap& target,
                                const SubmapOptions& options) {
  std::vector<float> distances;
  distances.reserve(source.size());
  for (const SurfacePatch& patch : source) {
    const Eigen::Vector3d normal = T_target_source.linear() * patch.normal;
    const MapSurface* surface = target.find(T_target_source * patch.mean, normal, patch.flat);
    const auto distance = distance_on(surface, patch, T_target_source, options);
    distances.push_back(distance ? float(*distance) : std::numeric_limits<float>::infinity());
  }
  return distances;
}

Overlap overlap_of(const SurfacePatches& source, const Pose& T_target_source, const PatchMap& target,
                   const Eigen::Vector3d& axis, const SubmapOptions& options) {
  constexpr double kAlong = 0.7;  // cosine
  double all = 0, landmarks = 0, same = 0, same_landmarks = 0, squares = 0;
  for (const SurfacePatch& patch : source) {
    if (patch.mean.norm() > options.range) continue;
    const bool landmark = !patch.flat || std::abs(patch.normal.dot(axis)) > kAlong;
    const Eigen::Vector3d normal = T_target_source.linear() * patch.normal;
    const auto distance =
        distance_on(target.find(T_target_source * patch.mean, normal, patch.flat), patch, T_target_source, options);
    ++all;
    landmarks += landmark;
    if (!distance) continue;
    ++same;
    same_landmarks += landmark;
    squares += *distance * *distance;
  }
  return {same / std::max(1.0, all), same_landmarks / std::max(1.0, landmarks),
          std::sqrt(squares / std::max(1.0, same))};
}

SurfacePatches moved(SurfacePatches patches, const Pose& T_target_source) {
  const Eigen::Matrix3d R = T_target_source.linear();
  for (SurfacePatch& patch : patches) {
    patch.mean = T_target_source * patch.mean;
    patch.normal = R * patch.normal;
    patch.covariance = R * patch.covariance * R.transpose();
  }
  return patches;
}

}  // namespace tilth
