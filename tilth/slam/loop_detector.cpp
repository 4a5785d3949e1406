#include <algorithm>
#include <cmath>

#include <tilth/slam/loop_detector.hpp>

namespace tilth {
namespace {

struct Scored {
  std::size_t keyframe;
  double score;  // the less, the better
};

void keep_best(std::vector<Scored>& scored, std::size_t most) {
  const auto better = [](const Scored& a, const Scored& b) {
    return a.score != b.score ? a.score < b.score : a.keyframe < b.keyframe;
  };
  std::sort(scored.begin(), scored.end(), better);
  scored.resize(std::min(scored.size(), most));
}

// Of keyframes on one pass only the best: the others see the same.
void keep_one_a_pass(std::vector<Scored>& scored, const PlacesSeen& places, double min_path) {
  std::vector<Scored> kept;
  for (const Scored& s : scored) {
    const auto on_its_pass = [&](const Scored& k) {
      return std::abs(places.keyframes[k.keyframe].path - places.keyframes[s.keyframe].path) < min_path / 2;
    };
    if (std::none_of(kept.begin(), kept.end(), on_its_pass)) kept.push_back(s);
  }
  scored.swap(kept);
}

double distance_to(const Expectation& expected) {
  return expected.T_from_to.translation().norm();
}

bool is_earlier_pass(const PlacesSeen& places, std::size_t keyframe, double min_path) {
  return places.keyframes.back().path - places.keyframes[keyframe].path >= min_path;
}

Pose turned_by(double yaw) {
  return Pose(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
}

}  // namespace

std::vector<LoopCandidate> candidates_by_radius(const PlacesSeen& places, const DetectOptions& options) {
  std::vector<Scored> near;
  for (std::size_t i = 0; i < places.keyframes.size(); ++i) {
    const Expectation& expected = places.expected[i];
    if (!is_earlier_pass(places, i, options.min_path)) break;
    if (!std::isfinite(expected.translation)) continue;
    if (distance_to(expected) <= options.radius + expected.translation) near.push_back({i, distance_to(expected)});
  }
  keep_best(near, near.size());
  keep_one_a_pass(near, places, options.min_path);
  keep_best(near, std::size_t(options.max_candidates));
  std::vector<LoopCandidate> candidates;
  for (const Scored& s : near)
    candidates.push_back(
        {s.keyframe, places.keyframes.size() - 1, places.expected[s.keyframe].T_from_to, FoundBy::radius});
  return candidates;
}

std::vector<LoopCandidate> candidates_by_context(const PlacesSeen& places, const DetectOptions& options) {
  const ScanContext& query = places.keyframes.back().context;
  std::vector<Scored> alike;
  for (std::size_t i = 0; i < places.keyframes.size(); ++i) {
    if (!is_earlier_pass(places, i, options.min_path)) break;
    const Expectation& expected = places.expected[i];
    if (!std::isfinite(expected.translation) || distance_to(expected) > options.radius + expected.translation) continue;
    alike.push_back({i, double((places.keyframes[i].context.ring_key - query.ring_key).norm())});
  }
  keep_best(alike, std::size_t(options.context_candidates));
  std::vector<LoopCandidate> candidates;
  for (Scored& s : alike) s.score = compare(query, places.keyframes[s.keyframe].context).distance;
  std::erase_if(alike, [&](const Scored& s) { return s.score > options.max_context_distance; });
  keep_best(alike, std::size_t(options.max_candidates));
  for (const Scored& s : alike) {
    const double yaw = compare(query, places.keyframes[s.keyframe].context).yaw;
    candidates.push_back({s.keyframe, places.keyframes.size() - 1, turned_by(yaw), FoundBy::context});
  }
  return candidates;
}

}  // namespace tilth
