#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>

#include <tilth/slam/graph_pieces.hpp>
#include <tilth/slam/loop_closer.hpp>

namespace tilth {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kWorthOptimizing = 1.0;  // [sigma^2] that an accepted closure and the graph differ by

// [m] of odometry on the shortest way from the newest keyframe to each, closures taken as no way at all (Dijkstra);
// infinite where a loss lies in between.
std::vector<double> paths_to(const std::vector<Keyframe>& keyframes, const std::vector<LoopClosure>& closures) {
  std::vector<std::vector<std::size_t>> joined(keyframes.size());
  for (const LoopClosure& closure : closures) {
    if (closure.verdict != Verdict::accepted) continue;
    joined[closure.constraint.from].push_back(closure.constraint.to);
    joined[closure.constraint.to].push_back(closure.constraint.from);
  }
  std::vector<double> paths(keyframes.size(), std::numeric_limits<double>::infinity());
  std::priority_queue<std::pair<double, std::size_t>, std::vector<std::pair<double, std::size_t>>, std::greater<>> open;
  const auto reach = [&](double path, std::size_t i) {
    if (path < paths[i]) open.emplace(paths[i] = path, i);
  };
  reach(0, keyframes.size() - 1);
  while (!open.empty()) {
    const auto [path, i] = open.top();
    open.pop();
    if (path > paths[i]) continue;
    if (i > 0 && !keyframes[i].severed) reach(path + keyframes[i].path - keyframes[i - 1].path, i - 1);
    if (i + 1 < keyframes.size() && !keyframes[i + 1].severed)
      reach(path + keyframes[i + 1].path - keyframes[i].path, i + 1);
    for (const std::size_t other : joined[i]) reach(path, other);
  }
  return paths;
}

}  // namespace

void LoopCloser::add(Keyframe keyframe, const std::function<void(std::string_view)>& begin_stage) {
  const Pose T_last_now = keyframes_.empty() ? keyframe.T_odometry_lidar
                                             : keyframes_.back().T_odometry_lidar.inverse() * keyframe.T_odometry_lidar;
  poses_.push_back(poses_.empty() ? T_last_now : normalized(poses_.back() * T_last_now));
  keyframes_.push_back(std::move(keyframe));

  begin_stage("loop_detection");
  const std::vector<Expectation> expected = expectations();
  const PlacesSeen places{keyframes_, expected};
  std::vector<LoopCandidate> candidates = candidates_by_radius(places, options_.detect);
  const std::vector<LoopCandidate> alike = candidates_by_context(places, options_.detect);
  if (candidates.empty() && alike.empty()) return;

  begin_stage("loop_verification");
  const std::size_t newest = keyframes_.size() - 1;
  const Submap to = submap(newest, newest - std::min(newest, std::size_t(options_.submap_to)), newest);
  const std::size_t before = closures_.size();
  if (!verify_all(candidates, expected, to)) verify_all(alike, expected, to);
  const bool worth = std::any_of(closures_.begin() + std::ptrdiff_t(before), closures_.end(), [](const auto& c) {
    return c.verdict == Verdict::accepted && c.squared_error > kWorthOptimizing;
  });
  if (!worth) return;
  begin_stage("pose_graph");
  optimize();
}

void LoopCloser::join_pieces(const std::vector<Constraint>& ties) {
  for (const Constraint& tie : ties)
    closures_.push_back({.constraint = tie, .found_by = FoundBy::map, .verdict = Verdict::accepted});
  optimize();
}

bool LoopCloser::verify_all(const std::vector<LoopCandidate>& candidates, const std::vector<Expectation>& expected,
                            const Submap& newest) {
  bool any = false;
  for (const LoopCandidate& candidate : candidates) {
    const auto reach = std::size_t(options_.submap_from);
    const Submap from =
        submap(candidate.from, candidate.from - std::min(candidate.from, reach), candidate.from + reach);
    LoopClosure closure = verify(candidate, from, newest, expected[candidate.from], options_.verify);
    if (closure.verdict == Verdict::accepted) {
      any = true;
      closure.verdict = confirm(closure) ? Verdict::accepted : Verdict::unconfirmed;
    }
    closures_.push_back(closure);
  }
  return any;
}

// Whether another verified closure says the same; that one then is confirmed as well.
bool LoopCloser::confirm(LoopClosure& closure) {
  const Constraint& mine = closure.constraint;
  closure.squared_error = squared_error(mine, poses_[mine.from], poses_[mine.to]);
  const auto path_between = [&](std::size_t a, std::size_t b) {
    return std::abs(keyframes_[a].path - keyframes_[b].path);
  };
  bool confirmed = false;
  for (LoopClosure& other : closures_) {
    const Constraint& theirs = other.constraint;
    const bool verified = other.verdict == Verdict::accepted || other.verdict == Verdict::unconfirmed;
    if (!verified || theirs.to == mine.to || path_between(theirs.to, mine.to) > options_.consistency.path ||
        path_between(theirs.from, mine.from) > 2 * options_.consistency.path)
      continue;
    const Pose T_to_to = poses_[mine.to].inverse() * poses_[theirs.to];
    const Pose T_from_from = poses_[mine.from].inverse() * poses_[theirs.from];
    const Pose around = mine.T_from_to * T_to_to * theirs.T_from_to.inverse() * T_from_from.inverse();
    if (around.translation().norm() > options_.consistency.distance ||
        angle_of(around) > options_.consistency.angle * kDegree)
      continue;
    other.verdict = Verdict::accepted;
    confirmed = true;
  }
  return confirmed;
}

std::vector<Expectation> LoopCloser::expectations() const {
  const std::vector<double> paths = paths_to(keyframes_, closures_);
  const UncertaintyOptions& o = options_.odometry;
  std::vector<Expectation> expected(keyframes_.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    expected[i] = {poses_[i].inverse() * poses_.back(), o.least + o.sigmas * o.drift * paths[i],
                   (o.least_turn + o.sigmas * o.turn_drift * paths[i]) * kDegree};
  }
  return expected;
}

Submap LoopCloser::submap(std::size_t center, std::size_t first, std::size_t last) const {
  SurfacePatches patches;
  const std::vector<std::size_t> pieces = pieces_of(keyframes_);
  for (std::size_t i = first; i <= std::min(last, keyframes_.size() - 1); ++i) {
    if (pieces[i] != pieces[center]) continue;
    const SurfacePatches more = moved(keyframes_[i].patches, poses_[center].inverse() * poses_[i]);
    patches.insert(patches.end(), more.begin(), more.end());
  }
  return Submap(std::move(patches), options_.verify.submap);
}

Constraint LoopCloser::odometry_constraint(std::size_t to) const {
  const Keyframe &a = keyframes_[to - 1], &b = keyframes_[to];
  const double path = std::max(b.path - a.path, 0.1), noise = options_.odometry.noise;
  const double turn_noise = options_.odometry.turn_noise * kDegree;
  Matrix6d covariance = options_.odometry.covariance_scale * b.covariance;
  covariance.diagonal().head<3>().array() += turn_noise * turn_noise * path;
  covariance.diagonal().tail<3>().array() += noise * noise * path;
  return {to - 1, to, a.T_odometry_lidar.inverse() * b.T_odometry_lidar, covariance.inverse(), false};
}

PoseGraph LoopCloser::graph() const {
  PoseGraph graph{.poses = poses_};
  for (std::size_t i = 1; i < keyframes_.size(); ++i) graph.constraints.push_back(odometry_constraint(i));
  for (const LoopClosure& closure : closures_)
    if (closure.verdict == Verdict::accepted) graph.constraints.push_back(closure.constraint);
  return graph;
}

std::vector<bool> LoopCloser::joined() const {
  const std::vector<std::size_t> pieces = pieces_of(keyframes_, closures_);
  std::vector<bool> joined(pieces.size());
  std::transform(pieces.begin(), pieces.end(), joined.begin(), [](std::size_t piece) { return piece == 0; });
  return joined;
}

// The optimisation starts from pieces that lie as the first closure between two of them says: nothing else does.
void LoopCloser::bring_together() {
  std::vector<std::size_t> pieces = pieces_of(keyframes_);
  for (const LoopClosure& closure : closures_) {
    const auto& [from, to, T_from_to, information, is_closure] = closure.constraint;
    if (closure.verdict != Verdict::accepted || pieces[from] == pieces[to]) continue;
    const Pose T_there_here = poses_[from] * T_from_to * poses_[to].inverse();
    const bool first_stays = pieces[to] != 0;  // the first keyframe is the world
    const std::size_t moves = first_stays ? pieces[to] : pieces[from];
    const Pose motion = first_stays ? T_there_here : T_there_here.inverse();
    for (std::size_t i = 0; i < poses_.size(); ++i)
      if (pieces[i] == moves) poses_[i] = normalized(motion * poses_[i]);
    join(pieces, from, to);
  }
}

void LoopCloser::optimize() {
  bring_together();
  while (true) {
    poses_ = tilth::optimize(graph(), options_.graph).poses;
    ++optimizations_;
    LoopClosure* worst = nullptr;
    for (LoopClosure& c : closures_) {
      if (c.verdict != Verdict::accepted) continue;
      c.squared_error = squared_error(c.constraint, poses_[c.constraint.from], poses_[c.constraint.to]);
      if (worst == nullptr || c.squared_error > worst->squared_error) worst = &c;
    }
    if (worst == nullptr || worst->squared_error <= options_.consistency.max_squared_error) return;
    worst->verdict = Verdict::outvoted;
  }
}

}  // namespace tilth
