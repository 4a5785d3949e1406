#include <tilth/freespace/floor_plane.hpp>
#include <tilth/localization/find_cloud.hpp>

namespace tilth {
namespace {

/// One cloud as a map of one place, turned so that its floor is level.
class CloudPlace final : public PlaceMap {
 public:
  CloudPlace(const PointCloud& cloud, const PatchOptions& options) : patches_(surface_patches(cloud, options)) {
    if (const auto floor = find_floor(cloud.points, Eigen::Vector3d::Zero())) T_level_cloud_ = levelling(*floor);
    patches_ = moved(std::move(patches_), T_level_cloud_);
    places_.push_back({.patches = std::uint32_t(patches_.size())});
    UprightGatherer gatherer;
    gatherer.add(patches_, Pose::Identity());
    uprights_ = gatherer.cells();
  }

  const std::vector<MapPlace>& places() const override { return places_; }
  const std::vector<UprightCell>& uprights() const override { return uprights_; }
  SurfacePatches patches(std::size_t) const override { return patches_; }

  const Pose& T_level_cloud() const { return T_level_cloud_; }
  PlaceQuery query(const PlaceCheckOptions& options) const { return place_query(patches_, patches_, options); }

 private:
  SurfacePatches patches_;
  Pose T_level_cloud_ = Pose::Identity();
  std::vector<MapPlace> places_;
  std::vector<UprightCell> uprights_;
};

/// Whether `target` is seen in `source` as well where the source was found in it.
bool found_back(const CloudPlace& source, const CloudPlace& target, const Pose& T_target_source,
                const FindCloudOptions& options) {
  MapTiles tiles(source, {}, options.check.submap);
  PlaceFinder finder(tiles, options.find, options.check);
  const Pose T_source_target = T_target_source.inverse();
  const PlaceQuery query = target.query(options.check);
  PlaceFit fit = check_place(query, *tiles.near(T_source_target.translation()), T_source_target, options.check);
  return finder.plausible(query, fit) && same_place(fit.T_map_lidar, T_source_target);
}

FoundPlace find_place(const CloudPlace& source, const CloudPlace& target, const FindCloudOptions& options) {
  MapTiles tiles(target, {}, options.check.submap);
  PlaceFinder finder(tiles, options.find, options.check);
  FoundPlace place = finder.find(source.query(options.check), {});
  if (place.answer == PlaceAnswer::found && !found_back(source, target, place.hypotheses[0].T_map_lidar, options))
    place.answer = PlaceAnswer::not_found;
  return place;
}

}  // namespace

FoundCloud find_cloud(const PointCloud& source, const PointCloud& target, const FindCloudOptions& options) {
  const CloudPlace of_source(source, options.align.patches), of_target(target, options.align.patches);
  FoundCloud found;
  if (of_source.patches(0).empty() || of_target.patches(0).empty()) return found;
  const FoundPlace place = find_place(of_source, of_target, options);
  if (place.answer == PlaceAnswer::not_found) return found;
  for (const PlaceFit& fit : place.hypotheses)
    found.hypotheses.emplace_back(of_target.T_level_cloud().inverse() * fit.T_map_lidar * of_source.T_level_cloud());
  found.answer = place.answer;
  if (found.answer != PlaceAnswer::found) return found;
  found.registration = align_clouds(source, target, found.hypotheses[0], options.align);
  if (!found.registration.converged || !same_place(found.registration.T_target_source, found.hypotheses[0])) return {};
  found.hypotheses = {found.registration.T_target_source};
  return found;
}

}  // namespace tilth
