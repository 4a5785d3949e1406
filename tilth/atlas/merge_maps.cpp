#include <algorithm>
#include <limits>

#include <tilth/atlas/map_writer.hpp>
#include <tilth/atlas/merge_maps.hpp>
#include <tilth/core/error.hpp>
#include <tilth/localization/gone_surfaces.hpp>
#include <tilth/localization/map_ties.hpp>
#include <tilth/slam/optimize.hpp>

namespace tilth {
namespace {

constexpr double kTieStep = 3.0;      // [m] between places that are looked for
constexpr double kInSight = 5.0;      // [m] from a later place within which earlier beams are asked
constexpr double kSameGround = 0.75;  // [m] within which a later place stands in for an earlier one

SurfacePatch placed(SurfacePatch patch, const Pose& T_map_lidar) {
  patch.mean = T_map_lidar * patch.mean, patch.normal = T_map_lidar.linear() * patch.normal;
  return patch;
}

/// What later beams went through of the first map, seen from where it has the tied places.
GoneSurfaces gone_between(const MapFolder& map, const MapFolder& later, const std::vector<MapTie>& ties,
                          const LocalizerOptions& options) {
  GoneSurfaces gone(options.check);
  MapTiles tiles(map, options.tiles, options.check.submap);
  for (const MapTie& tie : ties)
    gone.look(later.patches(tie.place), tie.T_map_place, tiles.near(tie.T_map_place.translation())->fine());
  return gone;
}

/// What beams of the first map went through of the later one, both as `poses` have them; the first `map` places of
/// those are the first map's.
GoneSurfaces came_between(const MapFolder& map, const MapFolder& later, std::span<const Pose> poses,
                          const LocalizerOptions& options) {
  GoneSurfaces came(options.check);
  MapTiles tiles(later, options.tiles, options.check.submap);
  const std::span<const Pose> own = poses.first(map.places().size()), others = poses.subspan(own.size());
  Eigen::Vector3d last = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < own.size(); ++i) {
    const Eigen::Vector3d at = own[i].translation();
    const auto nearest = std::min_element(others.begin(), others.end(), [&](const Pose& a, const Pose& b) {
      return (a.translation() - at).squaredNorm() < (b.translation() - at).squaredNorm();
    });
    if ((at - last).norm() < kTieStep || (nearest->translation() - at).norm() > kInSight) continue;
    last = at;
    const Pose& T_later_place = later.places()[std::size_t(nearest - others.begin())].T_map_lidar;
    const Pose T_later_lidar = T_later_place * nearest->inverse(Eigen::Isometry) * own[i];
    came.look(map.patches(i), T_later_lidar, tiles.near(T_later_lidar.translation())->fine());
  }
  return came;
}

/// Adds the patches of a map that changed, where `poses` of its places have them.
void add_changed(const MapFolder& map, std::span<const Pose> poses, const GoneSurfaces& gone, ChangeKind kind,
                 std::vector<ChangedPoint>& changed) {
  for (std::size_t i = 0; i < map.places().size(); ++i) {
    const MapPlace& place = map.places()[i];
    for (const SurfacePatch& patch : map.patches(i)) {
      if (gone.holds(placed(patch, place.T_map_lidar)))
        changed.push_back({(poses[i] * patch.mean).cast<float>(), {kind, place.stamp, place.stamp}});
    }
  }
}

std::vector<Change> changes_between(const MapFolder& map, const MapFolder& later, std::span<const Pose> poses,
                                    const GoneSurfaces& gone, const LocalizerOptions& options) {
  std::vector<ChangedPoint> changed;
  add_changed(map, poses, gone, ChangeKind::left, changed);
  add_changed(later, poses.subspan(map.places().size()), came_between(map, later, poses, options), ChangeKind::came,
              changed);
  return changes_of(changed, std::numeric_limits<double>::infinity());
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
    merged.gone +=
        std::erase_if(patches, [&](const SurfacePatch& patch) { return gone.holds(placed(patch, T_map_lidar)); });
    add(map, i, std::move(patches));
  }
  for (std::size_t i = 0; i < later.places().size(); ++i) add(later, i, later.patches(i));
  merged.changes = changes_between(map, later, graph.poses, gone, options);
  writer.finish({later.origin().program, map.origin().source + ", " + later.origin().source}, graph, later.beams());
  return merged;
}

}  // namespace tilth
