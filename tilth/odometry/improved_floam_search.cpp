// How the pipeline `improved_floam` finds a scan: from the motion expected on, or, where that is in doubt, from many.
#include <tilth/core/evenly_chosen.hpp>
#include <tilth/odometry/improved_floam.hpp>
#include <tilth/odometry/motion_search.hpp>
#include <tilth/preprocess/deskew.hpp>

namespace tilth {
namespace {

AlignOptions quick(AlignOptions align) {
  align.transformation_epsilon = align.rotation_epsilon = kFewEpsilon;
  align.max_iterations = std::min(align.max_iterations, kFewIterations);
  return align;
}

}  // namespace

ImprovedFloam::Registration ImprovedFloam::find(const FeatureScan& scan) {
  ambiguous_ = false;
  Registration found = register_scan_from(scan, expected(scan.stamp));
  if (motion_.updates() == 0) return found;
  const double interval = scan.stamp - motion_.last_time();
  if (motion_.updates() == 1) {
    if (fit_of(found.alignment) < kSureFit) found = search_start(scan, found);
  } else if (enough(scan.features.size()) && usual_.is_doubtful(found.alignment, interval)) {
    found = search(scan, found);
  }
  if (interval < kMapGivenUp || belongs_in_map(found.alignment, scan.stamp)) return found;
  begin_anew(scan.stamp);
  return register_scan_from(scan, motion_.predict(scan.stamp));
}

Pose ImprovedFloam::expected(double stamp) {
  told_.reset();
  if (external_ && motion_.updates() > 0) told_ = external_->between(motion_.last_time(), stamp);
  if (!told_) return motion_.predict(stamp);
  const double interval = stamp - motion_.last_time();
  const std::optional<MotionClaim> claim = trust_.claim(*told_, interval, motion_.velocity());
  if (!claim) return motion_.predict(stamp);
  return retract(motion_.last_pose(), interval * joined_velocity(motion_.velocity(), *claim, interval));
}

AlignResult ImprovedFloam::try_from(const FeatureScan& few, const Pose& T_start, const MotionInScan& motion) const {
  AlignOptions wide = quick(options_.align);
  wide.kernel_width = std::max(options_.first_kernel_width, wide.kernel_width);
  const Pose T = register_once(few, T_start, motion, wide).alignment.T_target_source;
  return register_once(few, T, motion, quick(options_.align)).alignment;
}

ImprovedFloam::Registration ImprovedFloam::search(const FeatureScan& scan, const Registration& expected) {
  const FeatureScan few{evenly_chosen<SurfacePatch>(scan.features, kFewPatches), scan.stamp, scan.middle};
  const MotionInScan motion = in_scan(motion_.velocity(), scan.middle);
  const Pose T_expected = motion_.predict(scan.stamp);
  const double interval = scan.stamp - motion_.last_time();
  const SurfacePatches seen = deskew(few.features, motion, scan.middle);
  const SearchWindow window = window_after(interval, motion_.velocity().tail<3>().norm());
  std::vector<AlignResult> tried;
  for (const Pose& T : poses_to_try(map_, seen, T_expected, motion_.last_pose(), window))
    tried.push_back(try_from(few, T, motion));
  const Choice choice = choose(tried);
  ambiguous_ = choice.ambiguous && (choice.best > 0 || interval > kPredictable);
  Registration found = expected;
  const Registration by_mean = register_scan_from(scan, tried[choice.best].T_target_source);
  const Registration by_last = register_once(scan, by_mean.alignment.T_target_source, motion, options_.align);
  for (const Registration& other : {by_mean, by_last})
    if (enough(other.alignment.matches) && fit_of(other.alignment) > fit_of(found.alignment)) found = other;
  return found;
}

ImprovedFloam::Registration ImprovedFloam::search_start(const FeatureScan& scan, const Registration& from_rest) {
  const SearchWindow window = window_at_start(scan.stamp - motion_.last_time());
  const FeatureScan few{evenly_chosen<SurfacePatch>(scan.features, kFewPatches), scan.stamp, scan.middle};
  std::vector<Pose> starts{from_rest.alignment.T_target_source};
  const PatchMap at_rest = map_;
  for (const PoseCandidate& candidate :
       search_poses(facing_points(map_), facing_points(scan.features), first_->T_world_middle, window, {}))
    starts.push_back(candidate.T_target_source);
  std::vector<AlignResult> tried;
  for (const Pose& T : starts) {
    const Vector6d velocity = motion_.velocity_to(scan.stamp, T);
    straighten_first(velocity);
    tried.push_back(try_from(few, T, in_scan(velocity, scan.middle)));
  }
  const Choice choice = choose(tried);
  Registration in_motion{.alignment = tried[choice.best]};
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds && choice.best > 0; ++round) {
    straighten_first(motion_.velocity_to(scan.stamp, in_motion.alignment.T_target_source));
    in_motion = register_scan_from(scan, in_motion.alignment.T_target_source);
  }
  ambiguous_ = choice.best > 0 && choice.ambiguous;
  if (choice.best > 0 && fit_of(in_motion.alignment) > kClearlyBetter * fit_of(from_rest.alignment)) return in_motion;
  map_ = at_rest;
  return from_rest;
}

MotionInScan ImprovedFloam::in_scan(const Vector6d& velocity, double middle) const {
  return options_.deskew ? MotionInScan::steady(velocity, middle) : MotionInScan();
}

void ImprovedFloam::straighten_first(const Vector6d& velocity) {
  map_ = PatchMap(options_.map);
  const MotionInScan motion = in_scan(velocity, first_->middle);
  map_.insert(deskew(first_->patches, motion, first_->middle), first_->T_world_middle);
}

void ImprovedFloam::begin_anew(double stamp) {
  const Pose T_world_expected = motion_.predict(stamp);
  motion_ = ConstantVelocity(T_world_expected);
  map_ = PatchMap(options_.map);
  usual_.forget();
  first_.reset();
  ambiguous_ = false;
  relative_ = true;
}

}  // namespace tilth
