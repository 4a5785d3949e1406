#include <algorithm>

#include <tilth/odometry/track_judge.hpp>

namespace tilth {
namespace {

constexpr double kThinScan = 0.3;    // of the usual candidates: spoils no map
constexpr double kCoast = 0.5;       // [s] at most
constexpr double kLongGap = 4.0;     // [s] after which the map must be found again
constexpr double kLeap = 60.0;       // [m/s^2] that no robot has
constexpr double kTurnLeap = 150.0;  // [rad/s^2]
constexpr std::size_t kStart = 4;    // scans until velocities are known
constexpr std::size_t kSome = 3;     // fits whose median says something
constexpr double kLeastFit = 0.35;   // of it: good runs of any pipeline keep above 0.4, lost ones fall to 0.3

}  // namespace

Track TrackJudge::judge(const OdometryResult& result) {
  const double interval = last_ ? result.stamp - last_->stamp : 0.0;
  if (last_ && !UsualFit::is_unmatched(result.alignment)) recent_.add(fit_of(result.alignment));
  const TrackReason reason = doubt(result, interval);
  track_ = reason == TrackReason::none ? believed(interval) : doubted(reason, result, interval);
  const Vector6d velocity = velocity_to(result, interval);
  last_ = Last{result.stamp, result.T_world_lidar, velocity};
  if (begins_map(result)) usual_.forget();
  const bool fits = reason == TrackReason::none || reason == TrackReason::new_map;
  if (!fits) usual_.doubt();
  if (fits && result.alignment.matches > 0) usual_.add(result.alignment, interval);
  if (reason != TrackReason::none) return track_;
  sizes_.add(double(std::max<std::size_t>(1, result.alignment.candidates)));
  return track_;
}

TrackReason TrackJudge::doubt(const OdometryResult& result, double interval) const {
  const AlignResult& alignment = result.alignment;
  if (sizes_.value() == 0) return alignment.converged ? TrackReason::none : TrackReason::too_few_matches;
  if (begins_map(result)) return TrackReason::new_map;
  if (usual_.is_unmatched(alignment)) return TrackReason::too_few_matches;
  if (result.ambiguous) return TrackReason::ambiguous;
  if (result.poor) return TrackReason::poor_fit;
  if (usual_.is_poor(alignment, result.relative ? interval : unknown_ + interval)) return TrackReason::poor_fit;
  if (recent_.size() >= kSome && std::max(recent_.value(), fit_of(alignment)) < kLeastFit) return TrackReason::poor_fit;
  if (result.relative) return TrackReason::new_map;
  if (since_doubt_ < kStart || !(interval > 0)) return TrackReason::none;
  const Vector6d change = (velocity_to(result, interval) - last_->velocity) / interval;
  const bool leaps = change.head<3>().norm() > kTurnLeap || change.tail<3>().norm() > kLeap;
  return leaps ? TrackReason::jump : TrackReason::none;
}

Vector6d TrackJudge::velocity_to(const OdometryResult& result, double interval) const {
  if (!last_) return Vector6d::Zero();
  if (!(interval > 0)) return last_->velocity;
  return log(last_->T_world_lidar.inverse() * result.T_world_lidar) / interval;
}

Track TrackJudge::doubted(TrackReason reason, const OdometryResult& result, double interval) {
  const bool was_lost = track_.state == TrackState::lost;
  unknown_ += interval;
  since_doubt_ = 0;
  const bool whole = double(result.alignment.candidates) > kThinScan * sizes_.value();
  if (result.in_map && whole && !result.relative) map_spoilt_ = true;
  const bool is_lost = was_lost || map_spoilt_ || unknown_ > kCoast;
  return {is_lost ? TrackState::lost : TrackState::coasting, reason};
}

Track TrackJudge::believed(double interval) {
  ++since_doubt_;
  if (map_spoilt_) return {TrackState::lost, track_.reason};
  const bool was_lost = track_.state == TrackState::lost;
  const bool gap = interval > kLongGap;
  unknown_ = 0.0;
  if (gap) return {TrackState::recovered, TrackReason::long_gap};
  return was_lost ? Track{TrackState::recovered, track_.reason} : Track{};
}

}  // namespace tilth
