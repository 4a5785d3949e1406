#include <algorithm>

#include <tilth/atlas/map_writer.hpp>
#include <tilth/atlas/merge_maps.hpp>
#include <tilth/core/error.hpp>
#include <tilth/localization/gone_surfaces.hpp>
#include <tilth/localization/map_ties.hpp>
#include <tilth/slam/optimize.hpp>

namespace tilth {
namespace {

constexpr double kTieStep = 3.0;      // [m] between places that are looked for
constexpr double kSameGround = 0.75;  // [m] within which a later place stands in for an earlier one

/// What later beams went through of the first map, seen from where it has the tied places.
GoneSurfaces gone_between(const MapFolder& map, const MapFolder& later, const std::vector<MapTie>& ties,
                          const LocalizerOptions& options) {
  GoneSurfaces gone(options.check);
  MapTiles tiles(map, options.tiles, options.check.submap);
  for (const MapTie& tie : ties)
    gone.look(later.patches(tie.place), tie.T_map_place, tiles.near(tie.T_map_place.translation())->fine());
  return gone;
}

bool is_replaced(const Pose& T_map_lidar, std::span<const Pose> later) {
  return std::any_of(later.begin(), later.end(), [&](const Pose& pose) {
    return (pose.translation() - T_map_lidar.translation()).norm() < kSameGround;
  });
}

}  // namespace

MergedMaps merge_maps(const MapFolder& map, const MapFolder& later, const LocalizerOptions& options,
                      const std::filesystem::path& folder) {
  const std::vector<MapTie> ties = find_ties(map, later, options, kTieStep);
  if (ties.empty()) throw Error(folder.string(), "is not written: the two maps do not overlap, or nothing tells where");
  PoseGraph graph = joined(map.graph(), later.graph(), ties);
  graph.poses = optimize(graph, {}).poses;
  const GoneSurfaces gone = gone_between(map, later, ties, options);
  const std::size_t first = map.places().size();
  const std::span<const Pose> later_poses = std::span(graph.poses).subspan(first);
  MergedMaps merged{.ties = ties.size()};
  MapWriter writer(folder);
  const auto add = [&](const MapFolder& from, std::size_t i, SurfacePatches patches) {
    MapPlace place = from.places()[i];
    place.T_map_lidar = graph.poses[&from == &map ? i : first + i];
    merged.places += !patches.empty();
    writer.add(place, patches);
  };
  for (std::size_t i = 0; i < first; ++i) {
    SurfacePatches patches;
    const bool replaced = is_replaced(graph.poses[i], later_poses);
    merged.replaced += replaced;
    if (!replaced) patches = map.patches(i);
    const Pose& T_map_lidar = map.places()[i].T_map_lidar;
    merged.gone += std::erase_if(patches, [&](const SurfacePatch& patch) {
      SurfacePatch placed = patch;
      placed.mean = T_map_lidar * patch.mean, placed.normal = T_map_lidar.linear() * patch.normal;
      return gone.holds(placed);
    });
    add(map, i, std::move(patches));
  }
  for (std::size_t i = 0; i < later.places().size(); ++i) add(later, i, later.patches(i));
  writer.finish({later.origin().program, map.origin().source + ", " + later.origin().source}, graph, later.beams());
  return merged;
}

}  // namespace tilth
