#include <algorithm>
#include <limits>

#include <tilth/localization/join_pieces.hpp>
#include <tilth/localization/map_ties.hpp>
#include <tilth/slam/graph_pieces.hpp>

namespace tilth {
namespace {

constexpr double kTieStep = 3.0;  // [m] between places that are looked for

/// Some keyframes of a drive as a map, where its pose graph has them.
class KeyframePlaces final : public PlaceMap {
 public:
  KeyframePlaces(const LoopCloser& loops, std::vector<std::size_t> chosen) : loops_(loops), chosen_(std::move(chosen)) {
    UprightGatherer gatherer;
    for (const std::size_t k : chosen_) {
      const Keyframe& keyframe = loops.keyframes()[k];
      places_.push_back(
          {keyframe.stamp, loops.poses()[k], keyframe.covariance, std::uint32_t(keyframe.patches.size())});
      gatherer.add(keyframe.patches, loops.poses()[k]);
    }
    uprights_ = gatherer.cells();
  }

  const std::vector<MapPlace>& places() const override { return places_; }
  const std::vector<UprightCell>& uprights() const override { return uprights_; }
  SurfacePatches patches(std::size_t place) const override { return loops_.keyframes()[chosen_[place]].patches; }
  std::size_t keyframe(std::size_t place) const { return chosen_[place]; }

 private:
  const LoopCloser& loops_;
  std::vector<std::size_t> chosen_;
  std::vector<MapPlace> places_;
  std::vector<UprightCell> uprights_;
};

/// The keyframe that stands nearest to a pose in the world.
std::size_t nearest(const KeyframePlaces& map, const Pose& T_world_place) {
  const auto distance = [&](const MapPlace& place) {
    return (place.T_map_lidar.translation() - T_world_place.translation()).norm();
  };
  const std::vector<MapPlace>& places = map.places();
  const auto found = std::min_element(places.begin(), places.end(),
                                      [&](const MapPlace& a, const MapPlace& b) { return distance(a) < distance(b); });
  return map.keyframe(std::size_t(found - places.begin()));
}

/// Ties are given in the frame of `map`; constraints join keyframes, the earlier one first.
std::vector<Constraint> constraints_of(const std::vector<MapTie>& ties, const KeyframePlaces& map,
                                       const KeyframePlaces& piece, const std::vector<Pose>& poses) {
  std::vector<Constraint> constraints;
  for (const MapTie& tie : ties) {
    const std::size_t from = nearest(map, tie.T_map_place);
    constraints.push_back(
        {from, piece.keyframe(tie.place), poses[from].inverse() * tie.T_map_place, tie.information, true});
  }
  return constraints;
}

}  // namespace

std::size_t join_pieces(Slam& slam, const LocalizerOptions& options) {
  const LoopCloser& loops = slam.loops();
  const std::vector<std::size_t> pieces = pieces_of(loops.keyframes());
  std::size_t count = 0;
  for (std::size_t first = 1; first < pieces.size(); ++first) {
    if (pieces[first] != first) continue;
    const std::vector<bool> joined = loops.joined();
    if (joined[first]) continue;
    std::vector<std::size_t> known, piece;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      if (pieces[k] == first) piece.push_back(k);
      if (joined[k] && k < first) known.push_back(k);
    }
    const KeyframePlaces map(loops, known), part(loops, piece);
    const std::vector<MapTie> ties = find_ties(map, part, options, kTieStep);
    if (ties.empty()) continue;
    slam.join_pieces(constraints_of(ties, map, part, loops.poses()));
    ++count;
  }
  return count;
}

}  // namespace tilth
