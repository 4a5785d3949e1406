// The surfaces of a map about a point, put together when they are asked for; what was not asked for lately is
// forgotten, so that memory does not grow with the map. 10 to 30 ms a tile, then nothing.
#pragma once

#include <list>
#include <memory>

#include <tilth/core/options.hpp>
#include <tilth/localization/place_map.hpp>
#include <tilth/slam/submap.hpp>

namespace tilth {

struct TileOptions {
  double step = 4.0;
  double radius = 12.0;
  int max_places = 24;
  int kept = 12;
};

template <class V>
void visit(TileOptions& o, V&& v) {
  v("step", o.step, Bounds{0.1, 1000}, "[m] between the middles of two tiles of a map, at least");
  v("radius", o.radius, Bounds{0.1, 1000}, "[m] places of the map within this of its middle join a tile");
  v("max_places", o.max_places, Bounds{1, 10000}, "[-] of a tile, evenly chosen");
  v("kept", o.kept, Bounds{1, 10000}, "[-] tiles in memory, those that were asked for last");
}

class MapTiles {
 public:
  /// `map` must outlive this.
  MapTiles(const PlaceMap& map, const TileOptions& tiles, const SubmapOptions& submaps);

  const PlaceMap& map() const { return map_; }

  /// The surfaces about the tile's middle that is nearest to `point`, in the map's frame.
  std::shared_ptr<const Submap> near(const Eigen::Vector3d& point);

  /// [m] from `point` to the nearest place of the map.
  double distance_to_map(const Eigen::Vector3d& point) const;

 private:
  struct Tile {
    std::size_t middle;
    std::shared_ptr<const Submap> submap;
  };

  std::shared_ptr<const Submap> make(std::size_t middle) const;

  const PlaceMap& map_;
  TileOptions options_;
  SubmapOptions submaps_;
  std::vector<std::size_t> middles_;  // places
  std::list<Tile> tiles_;             // asked for last, first
};

}  // namespace tilth
