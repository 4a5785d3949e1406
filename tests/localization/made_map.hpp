// A map in memory, made of a drive whose poses are the truth.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "slam/made_drives.hpp"
#include <tilth/localization/place_map.hpp>
#include <tilth/slam/keyframe.hpp>

namespace tilth {

class MadeMap final : public PlaceMap {
 public:
  void add(const MapPlace& place, SurfacePatches patches) {
    gatherer_.add(patches, place.T_map_lidar);
    places_.push_back(place);
    places_.back().patches = std::uint32_t(patches.size());
    patches_.push_back(std::move(patches));
    uprights_ = gatherer_.cells();
  }

  const std::vector<MapPlace>& places() const override { return places_; }
  const std::vector<UprightCell>& uprights() const override { return uprights_; }
  SurfacePatches patches(std::size_t place) const override { return patches_.at(place); }

 private:
  UprightGatherer gatherer_;
  std::vector<MapPlace> places_;
  std::vector<SurfacePatches> patches_;
  std::vector<UprightCell> uprights_;
};

/// A place about every metre of a drive; the map's frame is the LiDAR at its first scan.
inline MadeMap map_of(const Simulator& simulator) {
  MadeMap map;
  DriftingOdometry odometry(simulator, {});
  for (std::size_t i = 0; i < simulator.size(); ++i) {
    const Scan scan = simulator.scan(i).scan;
    const OdometryResult result = odometry.register_scan(scan);
    const bool first = map.places().empty();
    if (!first && !is_keyframe(map.places().back().T_map_lidar.inverse() * result.T_world_lidar, {})) continue;
    map.add({.stamp = result.stamp, .T_map_lidar = result.T_world_lidar}, keyframe_patches(result, scan.stamp, {}));
  }
  return map;
}

}  // namespace tilth
