#include <algorithm>
#include <cmath>
#include <numbers>

#include <tilth/simulation/mesh.hpp>
#include <tilth/simulation/scripted_walker.hpp>

namespace tilth {
namespace {

/// Between way-points `index - 1` and `index`, a share of the way on.
struct Step {
  std::size_t index = 0;
  double ratio = 0.0;
};

Step step_at(const ScriptedWalker& walker, double time) {
  const std::vector<Footing>& script = walker.script;
  const double round = walker.delay + script.back().time;
  if (walker.loop && round > 0) time = std::fmod(std::max(time, 0.0), round);
  time -= walker.delay;
  const auto next = std::find_if(script.begin(), script.end(), [&](const Footing& f) { return f.time > time; });
  if (next == script.begin()) return {0, 0.0};
  if (next == script.end()) return {script.size() - 1, 1.0};
  const double begin = (next - 1)->time;
  return {std::size_t(next - script.begin()), (time - begin) / (next->time - begin)};
}

}  // namespace

Pose pose_at(const ScriptedWalker& walker, double time) {
  const auto [index, ratio] = step_at(walker, time);
  const Footing& to = walker.script[index];
  const Footing& from = walker.script[index > 0 ? index - 1 : 0];
  const double turn = std::remainder(to.yaw - from.yaw, 2 * std::numbers::pi);
  return upright(from.position + ratio * (to.position - from.position), from.yaw + ratio * turn);
}

Eigen::AlignedBox3d feet_between(const ScriptedWalker& walker, double begin, double end) {
  Eigen::AlignedBox3d box(pose_at(walker, begin).translation());
  box.extend(pose_at(walker, end).translation());
  const std::size_t from = step_at(walker, begin).index, to = step_at(walker, end).index;
  const bool anew = to < from || (walker.loop && end - begin >= walker.delay + walker.script.back().time);
  for (std::size_t i = anew ? 0 : from; i < (anew ? walker.script.size() : to); ++i) {
    box.extend(walker.script[i].position);
  }
  return box;
}

double walked_at(const ScriptedWalker& walker, double time) {
  const auto [index, ratio] = step_at(walker, time);
  double walked = 0;
  for (std::size_t i = 1; i <= index; ++i) {
    const double leg = (walker.script[i].position - walker.script[i - 1].position).norm();
    walked += i < index ? leg : ratio * leg;
  }
  return walked;
}

}  // namespace tilth
