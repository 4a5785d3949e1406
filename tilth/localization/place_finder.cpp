#include <algorithm>
#include <cmath>
#include <numbers>

#include <tilth/localization/place_finder.hpp>
#include <tilth/localization/place_scale.hpp>

namespace tilth {
namespace {

/// Adds a fit where it was registered; of two at one place the better one stays.
void take(PlaceFit fit, std::vector<PlaceFit>& fits) {
  if (!fit.registered) return;
  const auto same = std::find_if(fits.begin(), fits.end(),
                                 [&](const PlaceFit& f) { return same_place(f.T_map_lidar, fit.T_map_lidar); });
  if (same == fits.end())
    fits.push_back(std::move(fit));
  else if (likeness_of(fit) > likeness_of(*same))
    *same = std::move(fit);
}

void best_first(std::vector<PlaceFit>& fits) {
  std::stable_sort(fits.begin(), fits.end(),
                   [](const PlaceFit& a, const PlaceFit& b) { return likeness_of(a) > likeness_of(b); });
}

}  // namespace

double likeness_of(const PlaceFit& fit) {
  double sum = 0;
  for (const float value : fit.fits) sum += double(value);
  return sum / std::max(1.0, double(fit.fits.size())) - fit.through;
}

PairedFit paired(const PlaceFit& first, const PlaceFit& second) {
  constexpr double kClearly = 0.35;  // by which noise alone seldom makes a fit better
  PairedFit shares;
  const std::size_t n = std::min(first.fits.size(), second.fits.size());
  for (std::size_t i = 0; i < n; ++i) {
    const double more = double(first.fits[i]) - double(second.fits[i]);
    if (std::abs(more) < kClearly) continue;
    (more > 0 ? shares.first : shares.second) += std::abs(more) / double(n);
  }
  return shares;
}

bool same_place(const Pose& T_map_a, const Pose& T_map_b) {
  constexpr double kDistance = 0.5, kAngle = 0.1;  // [m] [rad]
  const Pose apart = T_map_a.inverse() * T_map_b;
  return apart.translation().norm() < kDistance && angle_of(apart) < kAngle;
}

PlaceFinder::PlaceFinder(MapTiles& tiles, const PlaceFinderOptions& options, const PlaceCheckOptions& check)
    : tiles_(tiles), options_(options), check_(check), search_(tiles.map(), options.search) {}

bool PlaceFinder::fits_but_for_size(const PlaceFit& fit) const {
  return fit.registered && fit.determined.degenerate_directions == 0 && fit.overlap.ratio >= options_.min_overlap &&
         fit.overlap.landmarks >= options_.min_landmarks && fit.overlap.fitness <= options_.max_fitness &&
         fit.through <= options_.max_through && likeness_of(fit) >= options_.min_likeness;
}

void PlaceFinder::measure_size(const PlaceQuery& query, PlaceFit& fit) {
  if (fit.scale) return;
  fit.scale = scale_in_map(query.chosen, *tiles_.near(fit.T_map_lidar.translation()), fit.T_map_lidar, check_.submap);
}

bool PlaceFinder::plausible(const PlaceQuery& query, PlaceFit& fit) {
  if (!fits_but_for_size(fit)) return false;
  measure_size(query, fit);
  return std::abs(*fit.scale - 1) <= options_.max_scale_error;
}

std::vector<PlaceFit> PlaceFinder::tried(const PlaceQuery& query, const std::vector<Pose>& starts) {
  std::vector<PlaceFit> all;
  for (const Pose& start : starts) take(try_place(query, *tiles_.near(start.translation()), start, check_), all);
  best_first(all);
  return all;
}

std::vector<PlaceFit> PlaceFinder::fits(const PlaceQuery& query, const std::vector<Pose>& starts) {
  std::vector<PlaceFit> first = tried(query, starts);
  if (first.empty()) return first;
  // Turned about, what is here shows how well a wrong pose fits, also where the map has no other place like it.
  std::vector<Pose> turned;
  for (int quarter = 1; quarter < 4; ++quarter)
    turned.emplace_back(first[0].T_map_lidar *
                        Eigen::AngleAxisd(quarter * std::numbers::pi / 2, Eigen::Vector3d::UnitZ()));
  for (PlaceFit& fit : tried(query, turned)) take(std::move(fit), first);
  best_first(first);
  first.resize(std::min(first.size(), std::size_t(options_.registered)));
  std::vector<PlaceFit> all;
  for (const PlaceFit& fit : first)
    take(check_place(query, *tiles_.near(fit.T_map_lidar.translation()), fit.T_map_lidar, check_), all);
  best_first(all);
  return all;
}

FoundPlace PlaceFinder::find(const PlaceQuery& query, std::span<const Pose> guesses) {
  std::vector<Pose> starts(guesses.begin(), guesses.end());
  for (const PlaceCandidate& candidate : search_.find(query.patches)) starts.push_back(candidate.T_map_lidar);
  return choose(query, fits(query, starts));
}

FoundPlace PlaceFinder::find_about(const PlaceQuery& query, const Pose& T_map_given, double radius) {
  const auto is_far = [&](const Pose& T_map_lidar) {
    return (T_map_lidar.translation() - T_map_given.translation()).norm() > radius;
  };
  std::vector<Pose> starts{T_map_given};
  for (const PlaceCandidate& candidate : search_.find(query.patches))
    if (!is_far(candidate.T_map_lidar)) starts.push_back(candidate.T_map_lidar);
  std::vector<PlaceFit> near = fits(query, starts);
  std::erase_if(near, [&](const PlaceFit& fit) { return is_far(fit.T_map_lidar); });
  return choose(query, std::move(near));
}

bool PlaceFinder::less_likely(const PlaceFit& other, const PlaceFit& best) const {
  const PairedFit fit = paired(best, other);
  return fit.first > options_.alike * fit.second && fit.first - fit.second > options_.alike_least;
}

FoundPlace PlaceFinder::choose(const PlaceQuery& query, std::vector<PlaceFit> fits) {
  FoundPlace place{.hypotheses = std::move(fits)};
  std::vector<PlaceFit>& all = place.hypotheses;
  if (all.empty()) return place;
  const PlaceFit best = all[0];
  std::erase_if(all, [&](const PlaceFit& fit) { return less_likely(fit, best); });
  measure_size(query, all[0]);  // also where it is refused: who asks why nothing was found is told
  if (std::none_of(all.begin(), all.end(), [&](PlaceFit& fit) { return plausible(query, fit); })) return place;
  place.answer = all.size() == 1 ? PlaceAnswer::found : PlaceAnswer::ambiguous;
  return place;
}

}  // namespace tilth
