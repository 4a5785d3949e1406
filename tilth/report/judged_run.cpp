#include <tilth/core/error.hpp>
#include <tilth/report/judged_run.hpp>

namespace tilth {
namespace {

Similarity inverse(const Similarity& S) {
  const Eigen::Matrix3d R = S.rotation.transpose();
  return {1 / S.scale, R, -(1 / S.scale) * (R * S.translation)};
}

}  // namespace

JudgedRun judged(const Evaluation& evaluation) {
  const Trajectory to_run = transform(evaluation.matches.truth, inverse(evaluation.alignment));
  EvaluationOptions options = evaluation.options;
  options.align = Alignment::se3;
  options.association.interpolate = false;  // the matches hold the interpolated truth
  try {
    Evaluation aligned = evaluate_by_index(evaluation.matches.truth, evaluation.matches.estimate, options);
    Trajectory truth =
        transform(transform(evaluation.matches.truth, inverse(aligned.alignment)), inverse(evaluation.alignment));
    aligned.notices = evaluation.notices;
    aligned.matches.gaps = evaluation.matches.gaps;
    aligned.gap_limit = evaluation.gap_limit;
    return {std::move(aligned), "SE(3) over all poses", std::move(truth)};
  } catch (const Error&) {  // a straight way leaves the turn about itself open
    return {evaluation, "first poses equal", to_run};
  }
}

}  // namespace tilth
