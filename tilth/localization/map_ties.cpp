#include <algorithm>
#include <limits>

#include <tilth/localization/map_ties.hpp>

namespace tilth {
namespace {

/// Finds places of one map in another.
class TieFinder {
 public:
  TieFinder(const PlaceMap& map, const PlaceMap& other, const LocalizerOptions& options)
      : other_(other),
        options_(options),
        tiles_(map, options.tiles, options.check.submap),
        finder_(tiles_, options.find, options.check) {}

  /// From nothing.
  std::optional<MapTie> find(std::size_t place) {
    FoundPlace found = finder_.find(query(place), {});
    if (found.answer != PlaceAnswer::found) return std::nullopt;
    return tie_of(place, found.hypotheses.front());
  }

  /// About where it is expected.
  std::optional<MapTie> check(std::size_t place, const Pose& T_map_expected) {
    const Eigen::Vector3d at = T_map_expected.translation();
    if (tiles_.distance_to_map(at) > options_.find.search.off_way) return std::nullopt;
    const PlaceQuery about = query(place);
    PlaceFit fit = check_place(about, *tiles_.near(at), T_map_expected, options_.check);
    if (!finder_.plausible(about, fit) || !same_place(fit.T_map_lidar, T_map_expected)) return std::nullopt;
    return tie_of(place, fit);
  }

 private:
  static MapTie tie_of(std::size_t place, const PlaceFit& fit) {
    return {place, fit.T_map_lidar, fit.determined.information};
  }

  /// The patches of the places about one, in its frame.
  PlaceQuery query(std::size_t place) const {
    constexpr double kRadius = 3.0;  // [m]
    const std::vector<MapPlace>& places = other_.places();
    const Pose T_place_other = places[place].T_map_lidar.inverse();
    SurfacePatches patches;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Pose T_place_i = T_place_other * places[i].T_map_lidar;
      if (places[i].patches == 0 || T_place_i.translation().norm() > kRadius) continue;
      const SurfacePatches more = moved(other_.patches(i), T_place_i);
      patches.insert(patches.end(), more.begin(), more.end());
    }
    return place_query(std::move(patches), other_.patches(place), options_.check);
  }

  const PlaceMap& other_;
  LocalizerOptions options_;
  MapTiles tiles_;
  PlaceFinder finder_;
};

/// Places with patches, `step` [m] apart.
std::vector<std::size_t> spaced(const PlaceMap& map, double step) {
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < map.places().size(); ++i) {
    if (map.places()[i].patches == 0) continue;
    const auto apart = [&](std::size_t c) {
      return (map.places()[c].T_map_lidar.translation() - map.places()[i].T_map_lidar.translation()).norm();
    };
    if (chosen.empty() || apart(chosen.back()) >= step) chosen.push_back(i);
  }
  return chosen;
}

Pose T_map_other_by(const MapTie& tie, const PlaceMap& other) {
  return tie.T_map_place * other.places()[tie.place].T_map_lidar.inverse();
}

/// The first tie that another one confirms: its number among `chosen`.
std::optional<std::pair<std::size_t, MapTie>> confirmed(TieFinder& finder, const PlaceMap& other,
                                                        const std::vector<std::size_t>& chosen) {
  std::vector<std::pair<std::size_t, MapTie>> found;
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const std::optional<MapTie> tie = finder.find(chosen[k]);
    if (!tie) continue;
    const Pose& T_other_place = other.places()[chosen[k]].T_map_lidar;
    for (const auto& [number, before] : found) {
      if (same_place(T_map_other_by(before, other) * T_other_place, tie->T_map_place)) return std::pair{k, *tie};
    }
    found.emplace_back(k, *tie);
  }
  return std::nullopt;
}

}  // namespace

std::vector<MapTie> find_ties(const PlaceMap& map, const PlaceMap& other, const LocalizerOptions& options,
                              double step) {
  TieFinder finder(map, other, options);
  const std::vector<std::size_t> chosen = spaced(other, step);
  const auto seed = confirmed(finder, other, chosen);
  if (!seed) return {};
  std::vector<MapTie> ties{seed->second};
  const auto follow = [&](std::size_t place, Pose& T_map_other) {
    const auto tie = finder.check(place, T_map_other * other.places()[place].T_map_lidar);
    if (!tie) return;
    T_map_other = T_map_other_by(*tie, other);
    ties.push_back(*tie);
  };
  Pose T_forth = T_map_other_by(seed->second, other), T_back = T_forth;
  for (std::size_t k = seed->first + 1; k < chosen.size(); ++k) follow(chosen[k], T_forth);
  for (std::size_t k = seed->first; k > 0; --k) follow(chosen[k - 1], T_back);
  std::sort(ties.begin(), ties.end(), [](const MapTie& a, const MapTie& b) { return a.place < b.place; });
  return ties;
}

PoseGraph joined(const PoseGraph& graph, const PoseGraph& other, const std::vector<MapTie>& ties) {
  PoseGraph joint = graph;
  const std::size_t first = graph.poses.size();
  const Pose T_map_other = ties.front().T_map_place * other.poses[ties.front().place].inverse();
  for (const Pose& pose : other.poses) joint.poses.emplace_back(T_map_other * pose);
  for (Constraint constraint : other.constraints) {
    constraint.from += first, constraint.to += first;
    joint.constraints.push_back(constraint);
  }
  for (const MapTie& tie : ties) {
    const auto distance = [&](const Pose& pose) { return (pose.translation() - tie.T_map_place.translation()).norm(); };
    const auto nearest = std::min_element(graph.poses.begin(), graph.poses.end(),
                                          [&](const Pose& a, const Pose& b) { return distance(a) < distance(b); });
    joint.constraints.push_back({std::size_t(nearest - graph.poses.begin()), first + tie.place,
                                 nearest->inverse() * tie.T_map_place, tie.information, true});
  }
  return joint;
}

}  // namespace tilth
