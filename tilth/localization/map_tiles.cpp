#include <algorithm>
#include <limits>

#include <tilth/core/error.hpp>
#include <tilth/core/evenly_chosen.hpp>
#include <tilth/localization/map_tiles.hpp>

namespace tilth {

MapTiles::MapTiles(const PlaceMap& map, const TileOptions& tiles, const SubmapOptions& submaps)
    : map_(map), options_(tiles), submaps_(submaps) {
  const std::vector<MapPlace>& places = map_.places();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto near = [&](std::size_t m) {
      return (places[m].T_map_lidar.translation() - places[i].T_map_lidar.translation()).norm() < options_.step;
    };
    if (places[i].patches == 0) continue;
    if (std::none_of(middles_.begin(), middles_.end(), near)) middles_.push_back(i);
  }
  if (middles_.empty()) throw Error("map", "has no place with patches");
}

std::shared_ptr<const Submap> MapTiles::near(const Eigen::Vector3d& point) {
  const auto distance = [&](std::size_t m) { return (map_.places()[m].T_map_lidar.translation() - point).norm(); };
  const std::size_t middle = *std::min_element(middles_.begin(), middles_.end(),
                                               [&](std::size_t a, std::size_t b) { return distance(a) < distance(b); });
  const auto kept = std::find_if(tiles_.begin(), tiles_.end(), [&](const Tile& t) { return t.middle == middle; });
  if (kept != tiles_.end()) {
    tiles_.splice(tiles_.begin(), tiles_, kept);
  } else {
    tiles_.push_front({middle, make(middle)});
    if (tiles_.size() > std::size_t(options_.kept)) tiles_.pop_back();
  }
  return tiles_.front().submap;
}

std::shared_ptr<const Submap> MapTiles::make(std::size_t middle) const {
  const std::vector<MapPlace>& places = map_.places();
  const Eigen::Vector3d center = places[middle].T_map_lidar.translation();
  std::vector<std::size_t> within;
  for (std::size_t i = 0; i < places.size(); ++i)
    if (places[i].patches > 0 && (places[i].T_map_lidar.translation() - center).norm() <= options_.radius)
      within.push_back(i);
  SurfacePatches patches;
  for (const std::size_t i : evenly_chosen<std::size_t>(within, std::size_t(options_.max_places))) {
    const SurfacePatches more = moved(map_.patches(i), places[i].T_map_lidar);
    patches.insert(patches.end(), more.begin(), more.end());
  }
  return std::make_shared<const Submap>(std::move(patches), submaps_);
}

double MapTiles::distance_to_map(const Eigen::Vector3d& point) const {
  double least = std::numeric_limits<double>::infinity();
  for (const MapPlace& place : map_.places()) least = std::min(least, (place.T_map_lidar.translation() - point).norm());
  return least;
}

}  // namespace tilth
