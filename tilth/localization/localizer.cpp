#include <algorithm>

#include <tilth/core/evenly_chosen.hpp>
#include <tilth/localization/localizer.hpp>

namespace tilth {

Localizer::Localizer(const PlaceMap& map, MakeOdometry make_odometry, const LocalizerOptions& options,
                     const std::optional<Pose>& T_map_guess)
    : make_odometry_(std::move(make_odometry)),
      options_(options),
      tiles_(map, options.tiles, options.check.submap),
      finder_(tiles_, options.find, options.check),
      T_map_guess_(T_map_guess),
      odometry_(make_odometry_()) {}

void Localizer::forget() {
  odometry_ = make_odometry_();
  recent_.clear();
  carried_.clear();
  T_odometry_last_.reset();
  tracker_.reset();
}

LocatedScan Localizer::add(const Scan& scan) {
  bool lost = false;
  LocatedScan located{.odometry = register_scan(scan, lost)};
  const OdometryResult& result = located.odometry;
  if (tracker_) tracker_->move(T_odometry_last_->inverse() * result.T_world_lidar, result.alignment.covariance);
  T_odometry_last_ = result.T_world_lidar;
  const bool fresh = remember(result, scan.stamp);
  if (tracker_ && fresh) follow(located);
  if (!tracker_ && result.stamp - begun_ >= options_.first_after && result.stamp - searched_ >= options_.retry)
    search(located);
  if (!tracker_ && located.state != MapState::lost)
    located.state = carried_.empty() ? MapState::searching : MapState::ambiguous;
  if (lost) located.state = MapState::lost;
  if (!tracker_) return located;
  const bool moved_on = result.track.state == TrackState::coasting;
  located.state = hears_ && !moved_on ? MapState::located : MapState::coasting;
  located.T_map_lidar = tracker_->T_map_lidar();
  located.covariance = tracker_->covariance();
  located.overlap = overlap_, located.through = through_;
  return located;
}

OdometryResult Localizer::try_scan(const Scan& scan) {
  try {
    return odometry_->register_scan(scan);
  } catch (const Error& e) {
    throw UnusableScan("scan", e.what());
  }
}

OdometryResult Localizer::register_scan(const Scan& scan, bool& lost) {
  OdometryResult result = try_scan(scan);
  if (result.track.state == TrackState::lost || result.relative) {
    lost = tracker_.has_value();
    T_map_guess_.reset();
    forget();
    result = try_scan(scan);
  }
  if (!T_odometry_last_) begun_ = result.stamp, searched_ = begun_ - options_.retry;
  return result;
}

bool Localizer::remember(const OdometryResult& result, double scan_stamp) {
  if (!recent_.empty() && result.stamp - recent_.back().stamp < options_.step - 1e-6) return false;
  recent_.push_back({result.stamp, result.T_world_lidar, keyframe_patches(result, scan_stamp, options_.keyframe)});
  while (result.stamp - recent_.front().stamp > options_.window) recent_.pop_front();
  return true;
}

PlaceQuery Localizer::query() const {
  const Pose T_lidar_odometry = recent_.back().T_odometry_lidar.inverse();
  SurfacePatches patches;
  for (const Recent& recent : recent_) {
    const SurfacePatches more = moved(recent.patches, T_lidar_odometry * recent.T_odometry_lidar);
    patches.insert(patches.end(), more.begin(), more.end());
  }
  return place_query(std::move(patches), recent_.back().patches, options_.check);
}

std::vector<Pose> Localizer::carried(const Pose& T_odometry_lidar) const {
  std::vector<Pose> poses;
  for (const Pose& T_map_odometry : carried_) poses.push_back(T_map_odometry * T_odometry_lidar);
  return poses;
}

void Localizer::search(LocatedScan& located) {
  searched_ = located.odometry.stamp;
  const Pose T_odometry_lidar = recent_.back().T_odometry_lidar;
  FoundPlace place = T_map_guess_ ? finder_.find_about(query(), *T_map_guess_ * T_odometry_lidar, options_.at_radius)
                                  : finder_.find(query(), carried(T_odometry_lidar));
  const Pose T_seen_now = T_odometry_lidar.inverse() * located.odometry.T_world_lidar;
  carried_.clear();
  if (place.answer != PlaceAnswer::not_found)
    for (const PlaceFit& fit : place.hypotheses) carried_.push_back(fit.T_map_lidar * T_odometry_lidar.inverse());
  if (place.answer == PlaceAnswer::found) {
    const PlaceFit& fit = place.hypotheses.front();
    const Matrix6d to_now = adjoint(T_seen_now.inverse());
    tracker_.emplace(options_.track, fit.T_map_lidar * T_seen_now,
                     to_now * fit.determined.information.inverse() * to_now.transpose());
    usual_ = overlap_ = fit.overlap.ratio, through_ = fit.through;
    fitted_ = located.odometry.stamp, hears_ = true;
    carried_.clear();
    T_map_guess_.reset();
  }
  located.hypotheses = std::move(place.hypotheses);
  for (PlaceFit& fit : located.hypotheses) fit.T_map_lidar = fit.T_map_lidar * T_seen_now;
}

void Localizer::follow(LocatedScan& located) {
  PlaceCheckOptions check = options_.check;
  check.rays = std::min(check.rays, 100);
  const SurfacePatches few = evenly_chosen<SurfacePatch>(recent_.back().patches, std::size_t(options_.track_patches));
  const Submap& map = *tiles_.near(tracker_->T_map_lidar().translation());
  judge(follow_place(few, map, tracker_->T_map_lidar(), check), located);
}

void Localizer::judge(const PlaceFit& fit, LocatedScan& located) {
  constexpr double kFaded = 0.1;  // of the usual fit, at each registration
  const double now = located.odometry.stamp;
  overlap_ = fit.overlap.ratio, through_ = fit.through;
  const bool fits = fit.registered && overlap_ >= std::max(options_.min_fit, options_.usual_share * usual_) &&
                    through_ <= options_.max_through;
  hears_ = fits && tracker_->correct(fit.T_map_lidar, fit.determined.information);
  if (hears_) {
    usual_ += kFaded * (overlap_ - usual_);
    fitted_ = now;
    return;
  }
  const bool has_surfaces =
      tiles_.distance_to_map(tracker_->T_map_lidar().translation()) < options_.find.search.off_way;
  if ((has_surfaces || through_ > options_.max_through) && now - fitted_ >= options_.lost_after) lose(located);
}

void Localizer::lose(LocatedScan& located) {
  tracker_.reset();
  carried_.clear();
  located.state = MapState::lost;
  while (recent_.size() > 1) recent_.pop_front();
  begun_ = located.odometry.stamp, searched_ = begun_ - options_.retry;
}

}  // namespace tilth
