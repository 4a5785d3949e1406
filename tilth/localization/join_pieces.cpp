#include <algorithm>
#include <limits>

#include <tilth/localization/join_pieces.hpp>
#include <tilth/localization/map_ties.hpp>
#include <tilth/slam/graph_pieces.hpp>

namespace tilth {
namespace {

constexpr double kTieStep = 3.0;  // [m] between places that are looked for
constexpr double kWindow = 6.0;   // [m] of the newest places that are looked for at once while the drive goes on

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

/// The keyframes of the piece that begins with `first`, from `begin` on.
std::vector<std::size_t> piece_from(const std::vector<std::size_t>& pieces, std::size_t first, std::size_t begin) {
  std::vector<std::size_t> chosen;
  for (std::size_t k = begin; k < pieces.size(); ++k)
    if (pieces[k] == first) chosen.push_back(k);
  return chosen;
}

/// Looks for the keyframes `chosen`, all of one piece, in what lies before the piece and hangs together with the first.
bool join(LoopCloser& loops, std::size_t first, std::vector<std::size_t> chosen, const LocalizerOptions& options) {
  const std::vector<bool> joined = loops.joined();
  std::vector<std::size_t> known;
  for (std::size_t k = 0; k < first; ++k)
    if (joined[k]) known.push_back(k);
  const KeyframePlaces map(loops, std::move(known)), part(loops, std::move(chosen));
  const std::vector<MapTie> ties = find_ties(map, part, options, kTieStep);
  if (ties.empty()) return false;
  loops.join_pieces(constraints_of(ties, map, part, loops.poses()));
  return true;
}

}  // namespace

std::size_t join_pieces(LoopCloser& loops, const LocalizerOptions& options) {
  const std::vector<std::size_t> pieces = pieces_of(loops.keyframes());
  std::size_t count = 0;
  for (std::size_t first = 1; first < pieces.size(); ++first) {
    if (pieces[first] != first || loops.joined()[first]) continue;
    if (join(loops, first, piece_from(pieces, first, first), options)) ++count;
  }
  return count;
}

void PieceJoiner::operator()(LoopCloser& loops) {
  const std::vector<Keyframe>& keyframes = loops.keyframes();
  const double path = keyframes.back().path;
  if (keyframes.back().severed) tried_ = path;
  if (path - tried_ < kWindow || loops.joined().back()) return;
  tried_ = path;
  const std::vector<std::size_t> pieces = pieces_of(keyframes);
  const auto near = std::find_if(keyframes.begin(), keyframes.end(),
                                 [&](const Keyframe& keyframe) { return path - keyframe.path <= kWindow + kTieStep; });
  join(loops, pieces.back(), piece_from(pieces, pieces.back(), std::size_t(near - keyframes.begin())), options_);
}

}  // namespace tilth
