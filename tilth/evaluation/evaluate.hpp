// The judge: an estimated trajectory against the true one, by the measures that evo and the KITTI benchmark define.
// Cost: O(n log n) for n poses. docs/evaluation.md has every formula.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <tilth/core/options.hpp>
#include <tilth/evaluation/alignment.hpp>
#include <tilth/evaluation/ape.hpp>
#include <tilth/evaluation/kitti_metric.hpp>
#include <tilth/evaluation/open_roll.hpp>
#include <tilth/evaluation/rpe.hpp>

namespace tilth {

struct EvaluationOptions {
  Alignment align = Alignment::none;
  StampAssociationOptions association;
  RpeOptions rpe;
  bool kitti = false;  ///< the KITTI metric too
  /// Where the LiDAR sits on the body of whose motion the KITTI metric is taken, the camera of KITTI's own truth.
  Pose T_kitti_lidar = Pose::Identity();
};

template <class V>
void visit(EvaluationOptions& o, V&& v) {
  v("align", o.align,
    "[-] how the estimate is moved onto the truth: not at all, first poses equal, rigidly, rigidly with scale");
  v("max_dt", o.association.max_dt, Bounds{0, 1e9}, "[s] largest difference of two stamps that match");
  v("time_offset", o.association.time_offset, Bounds{-1e12, 1e12}, "[s] added to the estimate's stamps");
  v("interpolate", o.association.interpolate,
    "[-] truth interpolated at the estimate's stamps, instead of the nearest pose");
  v("max_gap", o.association.max_gap, Bounds{0, 1e9},
    "[s] longest gap of the truth that is interpolated over; 0: three of its median intervals, at least 0.2 s");
  v("rpe_delta", o.rpe.pairs.delta, Bounds{1e-9, 1e9},
    "[rpe_unit] distance of the two poses whose motion RPE compares");
  v("rpe_unit", o.rpe.pairs.unit, "[-] of rpe_delta: frames, metres of path, seconds");
  v("rpe_tolerance", o.rpe.pairs.tolerance, Bounds{0, 1},
    "[-] share of rpe_delta that a pair may miss it by (metres with all_pairs; seconds)");
  v("all_pairs", o.rpe.pairs.all_pairs, "[-] RPE over a pair from every pose, instead of pairs end to end");
  v("pairs_from_truth", o.rpe.pairs_from_truth, "[-] RPE's pairs picked on the truth, instead of the estimate");
  v("kitti", o.kitti, "[-] drift over segments of 100 to 800 m too");
}

struct Evaluation {
  EvaluationOptions options;    ///< that it was made with
  std::size_t truth_poses = 0;  ///< before matching
  std::size_t estimate_poses = 0;
  MatchedPoses matches;         ///< the estimate aligned
  Similarity alignment;         ///< that moved the estimate
  double start_distance = 0.0;  ///< [m] between the first matching poses, before alignment
  double start_angle = 0.0;     ///< [rad] likewise
  PoseErrors ape, rpe;
  std::optional<KittiMetric> kitti;
  std::optional<OpenRoll> open_roll;  ///< that an alignment by positions leaves
  double gap_limit = 0.0;             ///< [s] in force, where the truth was interpolated
  std::vector<std::string> notices;   ///< how the files were understood, one sentence each
};

/// Matches by stamps, aligns, measures. Throws Error where fewer than two poses match, and as its parts do.
Evaluation evaluate(const Trajectory& truth, const Trajectory& estimate, const EvaluationOptions& options);

/// Likewise by index: for trajectories of which one has no stamps. Throws Error where the options need stamps.
Evaluation evaluate_by_index(const Trajectory& truth, const Trajectory& estimate, const EvaluationOptions& options);

}  // namespace tilth
