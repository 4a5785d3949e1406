// How the pipeline `tilth` registers a scan: from the motion expected on, or, where that is in doubt, from many.
#include <algorithm>
#include <limits>

#include <tilth/core/evenly_chosen.hpp>
#include <tilth/odometry/motion_search.hpp>
#include <tilth/odometry/tilth_odometry.hpp>
#include <tilth/preprocess/deskew.hpp>

namespace tilth {
namespace {

std::vector<AlignResult> poses_of(const std::vector<ContinuousTimeAlignment>& alignments) {
  std::vector<AlignResult> poses;
  for (const ContinuousTimeAlignment& alignment : alignments) poses.push_back(alignment.pose);
  return poses;
}

}  // namespace

ContinuousTimeAlignment TilthOdometry::align(const ScanPatches& scan, const MotionPrior& prior) {
  const bool is_scan = enough(scan.patches.size());
  ambiguous_ = false;
  if (!world_.empty()) {
    const bool second = world_.awaits_second();
    ContinuousTimeAlignment found = second ? align_second(scan, prior) : align_to_map(scan, prior);
    if (!second && is_scan && usual_.is_doubtful(found.pose, prior.interval)) found = search(scan, prior, found);
    if (!is_scan || prior.interval < kMapGivenUp || belongs_in_map(found, prior.interval)) return found;
    begin_anew(predicted(prior));
  }
  if (!is_scan) return align_to_map(scan, prior);
  return {.pose = {.converged = true, .candidates = scan.patches.size()}};
}

ContinuousTimeAlignment TilthOdometry::align_to_map(const ScanPatches& scan, const MotionPrior& prior) const {
  return align_to_map(scan, prior, expected_state(prior, scan.middle()));
}

ContinuousTimeAlignment TilthOdometry::align_to_map(const ScanPatches& scan, const MotionPrior& prior,
                                                    const MotionState& start) const {
  return align_continuous_time(evenly_chosen<SurfacePatch>(scan.patches, std::size_t(options_.max_patches)), start,
                               prior, map_, options_.align);
}

ContinuousTimeAlignment TilthOdometry::try_from(const SurfacePatches& few, const MotionPrior& prior,
                                                const MotionState& start) const {
  ContinuousTimeOptions quick = options_.align;
  quick.max_iterations = std::min(quick.max_iterations, kFewIterations);
  return align_continuous_time(few, start, prior, map_, quick);
}

ContinuousTimeAlignment TilthOdometry::search(const ScanPatches& scan, const MotionPrior& prior,
                                              const ContinuousTimeAlignment& expected) {
  const SurfacePatches few = evenly_chosen<SurfacePatch>(scan.patches, kFewPatches);
  MotionState start = expected_state(prior, scan.middle());
  const SearchWindow window = window_after(prior.interval, prior.velocity.tail<3>().norm());
  const SurfacePatches seen = deskew(few, start.motion, scan.middle());
  std::vector<ContinuousTimeAlignment> tried;
  for (const Pose& T : poses_to_try(map_, seen, start.T_map_lidar, prior.T_map_last, window)) {
    start.T_map_lidar = T;
    tried.push_back(try_from(few, prior, start));
  }
  const Choice choice = choose(poses_of(tried));
  ambiguous_ = choice.ambiguous && (choice.best > 0 || prior.interval > kPredictable);
  start.T_map_lidar = tried[choice.best].pose.T_target_source, start.motion = tried[choice.best].motion;
  const ContinuousTimeAlignment found = align_to_map(scan, prior, start);
  return enough(found.pose.matches) && fit_of(found.pose) > fit_of(expected.pose) ? found : expected;
}

ContinuousTimeAlignment TilthOdometry::align_second(const ScanPatches& scan, MotionPrior prior) {
  const ContinuousTimeAlignment from_rest = align_with_first(scan, prior);
  if (fit_of(from_rest.pose) > kSureFit) return from_rest;
  const std::optional<Vector6d> velocity = search_start(scan, prior, from_rest);
  if (velocity) {
    prior.velocity = *velocity;
    straighten_first(*velocity);
    const ContinuousTimeAlignment in_motion = align_with_first(scan, prior);
    if (fit_of(in_motion.pose) > kClearlyBetter * fit_of(from_rest.pose)) return in_motion;
  }
  ambiguous_ = false;
  straighten_first(from_rest.motion.velocity);
  return from_rest;
}

ContinuousTimeAlignment TilthOdometry::align_with_first(const ScanPatches& scan, MotionPrior prior) {
  constexpr int kRounds = 4;
  ContinuousTimeAlignment alignment;
  for (int round = 0; round < kRounds; ++round) {
    alignment = align_to_map(scan, prior);
    prior.velocity = alignment.motion.velocity;
    straighten_first(prior.velocity);
  }
  return alignment;
}

void TilthOdometry::straighten_first(const Vector6d& velocity) {
  map_ = PatchMap(options_.map);
  map_.insert(world_.first_patches(velocity), Pose::Identity());
}

std::optional<Vector6d> TilthOdometry::search_start(const ScanPatches& scan, MotionPrior prior,
                                                    const ContinuousTimeAlignment& found) {
  const SurfacePatches few = evenly_chosen<SurfacePatch>(scan.patches, kFewPatches);
  std::vector<Vector6d> velocities{found.motion.velocity};
  for (const PoseCandidate& candidate :
       search_poses(facing_points(world_.first_scan().patches), facing_points(scan.patches), Pose::Identity(),
                    window_at_start(prior.interval), {}))
    velocities.push_back(log(candidate.T_target_source) / prior.interval);
  std::vector<ContinuousTimeAlignment> tried;
  for (const Vector6d& velocity : velocities) {
    prior.velocity = velocity;
    straighten_first(velocity);
    tried.push_back(try_from(few, prior, expected_state(prior, scan.middle())));
  }
  const Choice choice = choose(poses_of(tried));
  if (choice.best == 0) return std::nullopt;
  ambiguous_ = choice.ambiguous;
  return tried[choice.best].motion.velocity;
}

void TilthOdometry::begin_anew(const Pose& T_map_lidar) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  world_ = WorldFrame(kNever, world_.T_world_map() * T_map_lidar);
  motion_ = MotionFilter(options_.align.vibration);
  map_ = PatchMap(options_.map);
  uncertainty_ = {};
  usual_.forget();
  ambiguous_ = false;
  relative_ = true;
}

}  // namespace tilth
