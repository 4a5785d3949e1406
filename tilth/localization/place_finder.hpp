// Where in a map some scans were taken, from nothing: every pose that looks alike is registered and judged, and a pose
// is the answer only where it fits and no other does. A false place is worse than none.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include <tilth/localization/map_tiles.hpp>
#include <tilth/localization/place_check.hpp>
#include <tilth/localization/place_search.hpp>

namespace tilth {

struct PlaceFinderOptions {
  PlaceSearchOptions search;
  double min_overlap = 0.6;
  double min_landmarks = 0.4;
  double max_fitness = 0.06;
  double max_through = 0.1;
  double min_likeness = 0.5;
  double max_scale_error = 0.02;
  double alike = 3.0;
  double alike_least = 0.06;
  int registered = 8;
};

template <class V>
void visit(PlaceFinderOptions& o, V&& v) {
  v("search", o.search, "[-] search for poses that look alike", kAdvanced);
  v("min_overlap", o.min_overlap, Bounds{0, 1}, "[-] share of the patches that lie on surfaces of the map, at least");
  v("min_landmarks", o.min_landmarks, Bounds{0, 1}, "[-] the same of those that tell the least determined direction");
  v("max_fitness", o.max_fitness, Bounds{1e-4, 10}, "[m] root mean square distance of these from the surfaces");
  v("max_through", o.max_through, Bounds{0, 1}, "[-] share of beams that went through a surface of the map, at most");
  v("min_likeness", o.min_likeness, Bounds{0, 1},
    "[-] how well the patches lie on surfaces, less the beams that went through one, at least");
  v("max_scale_error", o.max_scale_error, Bounds{1e-4, 10},
    "[-] by which the scans may be larger or smaller than the map");
  v("alike", o.alike, Bounds{1, 100},
    "[-] another pose is less likely where so many times more speaks against it than for it, beside the best");
  v("alike_least", o.alike_least, Bounds{0, 1},
    "[-] share of the patches that must speak against another pose, those that speak for it taken off");
  v("registered", o.registered, Bounds{1, 10000},
    "[-] poses that are registered with all patches, the best of those tried");
}

enum class PlaceAnswer { found, ambiguous, not_found };
inline std::span<const std::string_view> names_of(PlaceAnswer) {
  static constexpr std::array<std::string_view, 3> names{"found", "ambiguous", "not_found"};
  return names;
}

struct FoundPlace {
  PlaceAnswer answer = PlaceAnswer::not_found;
  std::vector<PlaceFit> hypotheses = {};  ///< that may be, best first; of `found`, the first is the answer
};

/// How well a query fits in all: patches on surfaces less beams that went through one, 1 at best.
double likeness_of(const PlaceFit& fit);

/// Shares of the patches that clearly fit better at one pose than at another of the same query.
struct PairedFit {
  double first = 0.0, second = 0.0;
};
PairedFit paired(const PlaceFit& first, const PlaceFit& second);

/// Whether two poses are the same place: within 0.5 m and 6 degrees.
bool same_place(const Pose& T_map_a, const Pose& T_map_b);

class PlaceFinder {
 public:
  /// `tiles` must outlive this.
  PlaceFinder(MapTiles& tiles, const PlaceFinderOptions& options, const PlaceCheckOptions& check);

  /// `guesses` are looked at beside what the search finds.
  FoundPlace find(const PlaceQuery& query, std::span<const Pose> guesses);
  /// Only within `radius` [m] of a pose that is given.
  FoundPlace find_about(const PlaceQuery& query, const Pose& T_map_given, double radius);

  /// Whether a pose fits well enough to be one at all. The size of the query is asked for, and noted in `fit`, where
  /// all else fits.
  bool plausible(const PlaceQuery& query, PlaceFit& fit);

 private:
  std::vector<PlaceFit> tried(const PlaceQuery& query, const std::vector<Pose>& starts);
  std::vector<PlaceFit> fits(const PlaceQuery& query, const std::vector<Pose>& starts);
  FoundPlace choose(const PlaceQuery& query, std::vector<PlaceFit> fits);
  bool less_likely(const PlaceFit& other, const PlaceFit& best) const;
  bool fits_but_for_size(const PlaceFit& fit) const;
  void measure_size(const PlaceQuery& query, PlaceFit& fit);

  MapTiles& tiles_;
  PlaceFinderOptions options_;
  PlaceCheckOptions check_;
  PlaceSearch search_;
};

}  // namespace tilth
