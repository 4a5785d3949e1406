// One loop closure: two keyframes that may show the same place, and what became of the suspicion. Verified by
// registration of two submaps, by their overlap in both directions, and by asking whether another pose fits as well.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include <tilth/core/options.hpp>
#include <tilth/core/pose_graph.hpp>
#include <tilth/slam/submap.hpp>

namespace tilth {

struct VerifyOptions {
  SubmapOptions submap;
  double min_overlap = 0.65;
  double min_back_overlap = 0.35;
  double min_landmarks = 0.4;
  double max_fitness = 0.06;
  double degeneracy_ratio = 0.003;
  double noise = 0.01;
  double variance_scale = 10.0;
  double ambiguity_step = 0.5;
  double ambiguity = 0.85;
};

template <class V>
void visit(VerifyOptions& o, V&& v) {
  v("submap", o.submap, "[-] registration of two submaps");
  v("min_overlap", o.min_overlap, Bounds{0, 1},
    "[-] share of the newest patches that lie on surfaces of the earlier submap, at least");
  v("min_back_overlap", o.min_back_overlap, Bounds{0, 1}, "[-] share of the earlier patches on surfaces of the newest");
  v("min_landmarks", o.min_landmarks, Bounds{0, 1},
    "[-] min_overlap of the patches that tell the least determined direction: walls and floor alone make no place");
  v("max_fitness", o.max_fitness, Bounds{1e-4, 10}, "[m] root mean square distance of these patches from the surfaces");
  v("degeneracy_ratio", o.degeneracy_ratio, Bounds{0, 1},
    "[-] a direction with less information than this share of the best one is not constrained by a closure");
  v("noise", o.noise, Bounds{1e-6, 10},
    "[m] standard deviation of a closure, at least, also of the arc of its rotation");
  v("variance_scale", o.variance_scale, Bounds{1e-3, 1e6},
    "[-] by which a registration's covariance is enlarged, since neighbouring patches err alike");
  v("ambiguity_step", o.ambiguity_step, Bounds{0.05, 100}, "[m] between the poses that are tried beside the one found");
  v("ambiguity", o.ambiguity, Bounds{0, 1},
    "[-] another pose with this share of the overlap makes a closure ambiguous");
}

enum class Verdict {
  accepted,
  not_registered,
  little_overlap,
  poor_fitness,
  against_odometry,
  ambiguous,
  unconfirmed,
  outvoted
};
std::span<const std::string_view> names_of(Verdict);

enum class FoundBy { radius, context, map };  ///< map: found from nothing in all that was mapped before a loss
std::span<const std::string_view> names_of(FoundBy);

struct LoopCandidate {
  std::size_t from = 0, to = 0;  ///< keyframes, the earlier one first
  Pose T_from_to = Pose::Identity();
  FoundBy found_by = FoundBy::radius;
};

struct LoopClosure {
  Constraint constraint = {};  ///< between keyframes
  FoundBy found_by = FoundBy::radius;
  Verdict verdict = Verdict::not_registered;
  double overlap = 0.0, back_overlap = 0.0;  ///< [-] of the newest patches, of the earlier ones
  double landmarks = 0.0;                    ///< [-] overlap of those that tell the least determined direction
  double fitness = 0.0;                      ///< [m]
  int degenerate_directions = 0;
  double squared_error = 0.0;  ///< [sigma^2] against what was expected, later against the optimised graph
};

/// What odometry leaves open of the motion between two keyframes: bounds on the error of `T_from_to`.
struct Expectation {
  Pose T_from_to = Pose::Identity();
  double translation = 0.0;  ///< [m]
  double rotation = 0.0;     ///< [rad]
};

/// Whether `T_from_to` lies within the bounds.
bool agrees(const Pose& T_from_to, const Expectation& expected);

/// Registers the query's submap (`to`) to the candidate's (`from`), each in the frame of its keyframe, and tests the
/// result. The verdict `accepted` says that this closure alone raises no doubt.
LoopClosure verify(const LoopCandidate& candidate, const Submap& from, const Submap& to, const Expectation& expected,
                   const VerifyOptions& options);

}  // namespace tilth
