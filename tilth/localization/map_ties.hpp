// Where two maps show the same: places of one that are found in the other, as ties between their pose graphs. The first
// two must find each other from nothing and agree; all others must then lie where these say. False ties are worse than
// missed ones.
#pragma once

#include <tilth/core/pose_graph.hpp>
#include <tilth/localization/localizer.hpp>

namespace tilth {

struct MapTie {
  std::size_t place = 0;                        ///< of the other map
  Pose T_map_place = Pose::Identity();          ///< where the map has it
  Matrix6d information = Matrix6d::Identity();  ///< [1/rad^2, 1/m^2] of that, right perturbation
};

/// Ties by places of `other` about every `step` [m]; empty where the maps do not overlap, or nothing tells where. By
/// the order of the places.
std::vector<MapTie> find_ties(const PlaceMap& map, const PlaceMap& other, const LocalizerOptions& options, double step);

/// The graphs of two maps as one: the poses of the first, then those of the other, in the first one's frame.
PoseGraph joined(const PoseGraph& graph, const PoseGraph& other, const std::vector<MapTie>& ties);

}  // namespace tilth
