// Whether a scan was taken at a pose of a map: registered as a loop closure is, judged by how its patches lie on the
// map's surfaces, and by whether beams went through what the map says stands there. 5 to 20 ms.
#pragma once

#include <functional>
#include <optional>

#include <tilth/core/options.hpp>
#include <tilth/slam/submap.hpp>
#include <tilth/slam/submap_information.hpp>

namespace tilth {

struct PlaceCheckOptions {
  SubmapOptions submap;
  int max_patches = 1500;
  int few_patches = 400;
  int rays = 300;
  double near_side = 0.5;
  double likeness = 0.03;
  double degeneracy_ratio = 0.003;
  double noise = 0.01;
  double variance_scale = 10.0;
};

template <class V>
void visit(PlaceCheckOptions& o, V&& v) {
  v("submap", o.submap, "[-] registration to the map");
  v("max_patches", o.max_patches, Bounds{50, 1e6}, "[patches] of the newest scans that are registered, evenly chosen");
  v("few_patches", o.few_patches, Bounds{50, 1e6},
    "[patches] that poses are tried with, of which the best are registered");
  v("rays", o.rays, Bounds{1, 1e6}, "[-] beams that are followed through the map, evenly chosen");
  v("near_side", o.near_side, Bounds{0, 100}, "[m] before its end, over which a beam is not followed");
  v("likeness", o.likeness, Bounds{1e-3, 1},
    "[m] standard deviation of a patch from its surface, by which poses are compared");
  v("degeneracy_ratio", o.degeneracy_ratio, Bounds{0, 1},
    "[-] a direction with less information than this share of the best one is not determined");
  v("noise", o.noise, Bounds{1e-6, 10},
    "[m] standard deviation of a pose in the map, at least, also of the arc of its rotation");
  v("variance_scale", o.variance_scale, Bounds{1e-3, 1e6},
    "[-] by which a registration's covariance is enlarged, since neighbouring patches err alike");
}

/// The newest scans in the frame of the last of them.
struct PlaceQuery {
  SurfacePatches patches;      ///< all of them
  SurfacePatches chosen, few;  ///< what poses are judged by, and what they are tried with
  SurfacePatches newest;       ///< of the last scan alone
};

/// A query of `patches`, which are those of `newest` and of scans before.
PlaceQuery place_query(SurfacePatches patches, SurfacePatches newest, const PlaceCheckOptions& options);

/// How a query fits a map at a pose.
struct PlaceFit {
  Pose T_map_lidar = Pose::Identity();
  bool registered = false;
  Overlap overlap = {};          ///< of the query's patches on surfaces of the map
  std::vector<float> fits = {};  ///< of each chosen patch: 1 on a surface, 0 far from any
  double through = 0.0;          ///< share of the newest beams that went through a surface of the map
  SubmapInformation determined = {};
  std::optional<double> scale = {};  ///< the map's size over that of the query, where it was asked for: place_scale.hpp
};

/// T_map_start refined by registration to `map`, which is in the map's frame, and judged there.
PlaceFit check_place(const PlaceQuery& query, const Submap& map, const Pose& T_map_start,
                     const PlaceCheckOptions& options);

/// The same by few patches, without what beams went through and without the information: about 2 ms.
PlaceFit try_place(const PlaceQuery& query, const Submap& map, const Pose& T_map_start,
                   const PlaceCheckOptions& options);

/// `patches` of one scan registered to the fine surfaces of `map` from a pose that is nearly right, and judged there,
/// but for the overlap back.
PlaceFit follow_place(const SurfacePatches& patches, const Submap& map, const Pose& T_map_expected,
                      const PlaceCheckOptions& options);

/// Follows each beam that ends at `patches`, and tells `f` the first surface of `map` that it passes through. How many
/// beams there were.
std::size_t for_each_passed(const SurfacePatches& patches, const PatchMap& map, const Pose& T_map_lidar,
                            const PlaceCheckOptions& options, const std::function<void(const MapSurface&)>& f);

/// The share of beams that end at `patches` and pass through a surface of `map` on their way.
double share_through(const SurfacePatches& patches, const PatchMap& map, const Pose& T_map_lidar,
                     const PlaceCheckOptions& options);

}  // namespace tilth
