#include <algorithm>
#include <cmath>

#include <tilth/core/evenly_chosen.hpp>
#include <tilth/localization/place_check.hpp>

namespace tilth {
namespace {

/// The flat, well-known surface near `point` that a beam goes through, on which it should have ended; or nullptr.
const MapSurface* passed_at(const PatchMap& map, const Eigen::Vector3d& point, const Eigen::Vector3d& direction) {
  constexpr double kGrazing = 0.35, kSide = 0.3, kApart = 0.11, kThick = 0.04;  // cosine, [m]
  constexpr std::uint32_t kSeenOften = 4;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(direction[axis]) < kGrazing) continue;
    const Eigen::Vector3d facing = -std::copysign(1.0, direction[axis]) * Eigen::Vector3d::Unit(axis);
    const MapSurface* surface = map.find(point, facing, true);
    if (surface == nullptr || surface->patches < kSeenOften || surface->variance > kThick * kThick) continue;
    const Eigen::Vector3d offset = point - surface->mean;
    const double along = surface->normal.dot(offset);
    if (-surface->normal.dot(direction) < kGrazing || std::abs(along) > kApart) continue;
    if ((offset - along * surface->normal).norm() < kSide) return surface;
  }
  return nullptr;
}

std::vector<float> fits_of(const SurfacePatches& patches, const Submap& map, const Pose& T_map_lidar,
                           const PlaceCheckOptions& options) {
  std::vector<float> fits = distances_on(patches, T_map_lidar, map.fine(), options.submap);
  for (float& value : fits) value = std::exp(-0.5F * value * value / float(options.likeness * options.likeness));
  return fits;
}

/// Where the registration of `patches` ended: how many lie on surfaces there, and what it determines.
PlaceFit fit_of(const AlignResult& found, const SurfacePatches& patches, const Submap& map,
                const PlaceCheckOptions& options) {
  PlaceFit fit{.T_map_lidar = found.T_target_source, .registered = true};
  fit.overlap = overlap_of(patches, fit.T_map_lidar, map.fine(), weakest_axis(found.information), options.submap);
  fit.determined = weighed_information(found.information, patches,
                                       {options.degeneracy_ratio, options.noise, options.variance_scale});
  return fit;
}

}  // namespace

PlaceQuery place_query(SurfacePatches patches, SurfacePatches newest, const PlaceCheckOptions& options) {
  PlaceQuery query;
  query.chosen = evenly_chosen<SurfacePatch>(patches, std::size_t(options.max_patches));
  query.few = evenly_chosen<SurfacePatch>(patches, std::size_t(options.few_patches));
  query.patches = std::move(patches);
  query.newest = std::move(newest);
  return query;
}

std::size_t for_each_passed(const SurfacePatches& patches, const PatchMap& map, const Pose& T_map_lidar,
                            const PlaceCheckOptions& options, const std::function<void(const MapSurface&)>& f) {
  constexpr double kStep = 0.2;  // [m]
  const Eigen::Vector3d from = T_map_lidar.translation();
  std::size_t beams = 0;
  for (const SurfacePatch& patch : patches) {
    const double range = patch.mean.norm();
    if (range > options.submap.range || range < 2 * options.near_side) continue;
    ++beams;
    const Eigen::Vector3d direction = T_map_lidar.linear() * (patch.mean / range);
    for (double at = options.near_side; at < range - options.near_side; at += kStep) {
      const MapSurface* surface = passed_at(map, from + at * direction, direction);
      if (surface == nullptr) continue;
      f(*surface);
      break;
    }
  }
  return beams;
}

double share_through(const SurfacePatches& patches, const PatchMap& map, const Pose& T_map_lidar,
                     const PlaceCheckOptions& options) {
  std::size_t through = 0;
  const std::size_t all = for_each_passed(evenly_chosen<SurfacePatch>(patches, std::size_t(options.rays)), map,
                                          T_map_lidar, options, [&](const MapSurface&) { ++through; });
  return double(through) / double(std::max<std::size_t>(1, all));
}

PlaceFit check_place(const PlaceQuery& query, const Submap& map, const Pose& T_map_start,
                     const PlaceCheckOptions& options) {
  const AlignResult found = register_submap(query.chosen, map, T_map_start, options.submap);
  if (!found.converged) return {.T_map_lidar = T_map_start};
  PlaceFit fit = fit_of(found, query.chosen, map, options);
  fit.fits = fits_of(query.chosen, map, fit.T_map_lidar, options);
  fit.through = share_through(query.newest, map.fine(), fit.T_map_lidar, options);
  return fit;
}

PlaceFit try_place(const PlaceQuery& query, const Submap& map, const Pose& T_map_start,
                   const PlaceCheckOptions& options) {
  const AlignResult found = register_submap(query.few, map, T_map_start, options.submap);
  if (!found.converged) return {.T_map_lidar = T_map_start};
  PlaceFit fit{.T_map_lidar = found.T_target_source, .registered = true};
  fit.fits = fits_of(query.chosen, map, fit.T_map_lidar, options);
  return fit;
}

PlaceFit follow_place(const SurfacePatches& patches, const Submap& map, const Pose& T_map_expected,
                      const PlaceCheckOptions& options) {
  constexpr std::size_t kLeast = 30;  // pairs; whether the last step was small enough does not matter here
  const AlignResult found = refine(patches, map, T_map_expected, options.submap);
  if (found.matches < kLeast) return {.T_map_lidar = T_map_expected};
  PlaceFit fit = fit_of(found, patches, map, options);
  fit.through = share_through(patches, map.fine(), fit.T_map_lidar, options);
  return fit;
}

}  // namespace tilth
