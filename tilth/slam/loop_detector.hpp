// Which earlier keyframes may show the same place as the newest one: those within the radius that odometry leaves open,
// and those whose descriptor looks alike, whatever the heading. O(keyframes) a query, with a small constant.
#pragma once

#include <span>
#include <vector>

#include <tilth/core/options.hpp>
#include <tilth/slam/keyframe.hpp>
#include <tilth/slam/loop_closure.hpp>

namespace tilth {

struct DetectOptions {
  double min_path = 20.0;
  double radius = 5.0;
  int max_candidates = 2;
  int context_candidates = 10;
  double max_context_distance = 0.35;
};

template <class V>
void visit(DetectOptions& o, V&& v) {
  v("min_path", o.min_path, Bounds{0, 1e6}, "[m] travelled between two passes of a place, at least");
  v("radius", o.radius, Bounds{0, 1e4}, "[m] about the expected place in which earlier keyframes are looked for");
  v("max_candidates", o.max_candidates, Bounds{1, 1000}, "[-] keyframes verified of either kind");
  v("context_candidates", o.context_candidates, Bounds{1, 10000},
    "[-] keyframes with the most similar rings, whose descriptors are compared", kAdvanced);
  v("max_context_distance", o.max_context_distance, Bounds{0, 1}, "[-] of two descriptors that look alike", kAdvanced);
}

/// What the detector sees: all keyframes, the newest last, where each is thought to be, and what is left open of the
/// motion between each of them and the newest: without bound (infinite) where the track was lost in between.
struct PlacesSeen {
  std::span<const Keyframe> keyframes;
  std::span<const Expectation> expected;
};

/// Candidates about the expected place, nearest first; they start from where the keyframes are thought to be. Of a
/// second pass nearby only the nearest keyframe is taken.
std::vector<LoopCandidate> candidates_by_radius(const PlacesSeen& places, const DetectOptions& options);

/// Candidates by Scan Context within what odometry leaves open, most alike first; they start from the same place,
/// turned by the yaw that the descriptors tell.
std::vector<LoopCandidate> candidates_by_context(const PlacesSeen& places, const DetectOptions& options);

}  // namespace tilth
