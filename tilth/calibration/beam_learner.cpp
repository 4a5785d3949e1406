#include <algorithm>
#include <utility>

#include <tilth/calibration/beam_learner.hpp>

namespace tilth {
namespace {

constexpr std::size_t kFirst = 3;     // windows that the first solution waits for
constexpr std::size_t kMostKept = 6;  // windows whose returns are held
constexpr double kSmall = 0.25;       // deviations of the prior, of errors that one linearization is enough for
constexpr int kRounds = 3;            // of the first solution; later ones begin near their end

}  // namespace

BeamLearner::BeamLearner(const BeamCalibrationOptions& options, std::optional<BeamEstimate> known)
    : options_(options), known_(std::move(known)), due_(kFirst) {}

void BeamLearner::add(std::vector<BeamKeyframe> window, std::size_t rings, double bright) {
  if (!units_ || rings > prior_.model.beams()) begin(rings, bright);
  keyframes_ += window.size(), ++added_;
  kept_.push_back({std::move(window), {}, {}});
}

/// Windows of fewer beams than the sensor turns out to have are forgotten.
void BeamLearner::begin(std::size_t rings, double bright) {
  prior_ = known_ ? completed(*known_, rings, options_) : prior_beams(rings, bright, options_);
  known_model_ = prior_.model;
  prior_.model = BeamModel{};
  prior_.model.bright = known_model_.bright;
  prior_.model = with_parameters(prior_.model, Eigen::VectorXd::Zero(prior_.covariance.rows()));
  units_.emplace(prior_);
  theta_ = units_->mean;
  model_ = prior_.model;
  kept_.clear(), frozen_.clear(), found_.reset();
  next_ = 0, round_ = 0, due_ = kFirst, added_ = 0, keyframes_ = 0;
}

bool BeamLearner::work() {
  if (next_ == kept_.size()) return false;
  Kept& window = kept_[next_++];
  window.linear = beam_window(window.keyframes, with_parameters(prior_.model, theta_), prior_.model.beams(), options_);
  window.evidence = evidence_of(window.linear, *units_, theta_);
  return next_ == kept_.size() && added_ >= due_ && end_of_round();
}

bool BeamLearner::end_of_round() {
  const std::vector<WindowEvidence> all = evidence();
  if (!found_ && round_ == 0) before_ = fit_of_kept();
  if (!found_ && round_ + 1 < kRounds) {
    const Eigen::VectorXd y = posterior_mean(all, 1 + options_.model_error * double(all.size()));
    if (round_ > 0 || y.cwiseAbs().maxCoeff() > kSmall) {
      move_to(units_->mean + units_->spread * y);
      ++round_, next_ = 0;
      return false;
    }
  }
  const BeamBelief belief = believe(all, options_);
  move_to(units_->mean + units_->spread * belief.y);
  tell(belief);
  round_ = 0, due_ = added_ + std::max<std::size_t>(1, added_ / 4);
  freeze();
  return true;
}

BeamFit BeamLearner::fit_of_kept() const {
  std::vector<BeamWindow> linear;
  for (const Kept& window : kept_) linear.push_back(window.linear);
  return fit_of(linear);
}

std::vector<WindowEvidence> BeamLearner::evidence() const {
  std::vector<WindowEvidence> all = frozen_;
  for (const Kept& window : kept_) all.push_back(window.evidence);
  return all;
}

/// The errors that windows are linearized at from now on; poses follow.
void BeamLearner::move_to(const Eigen::VectorXd& theta) {
  const Eigen::VectorXd step = theta - theta_;
  theta_ = theta;
  for (Kept& window : kept_) follow(window.keyframes, window.linear, step);
}

void BeamLearner::tell(const BeamBelief& belief) {
  if (!found_) found_.emplace(), found_->before = before_;
  found_->after = fit_of_kept();
  found_->windows = added_, found_->keyframes = keyframes_;
  found_->directions = std::size_t(belief.y.size()), found_->believed = belief.believed;
  model_ = with_parameters(prior_.model, theta_);
  const std::size_t n = model_.beams();
  found_->beams.model = with_parameters(known_model_, parameters_of(known_model_, n) + theta_);
  found_->beams.covariance = units_->spread * belief.covariance * units_->spread.transpose();
}

/// Returns of all but the newest windows are let go; of windows that say much already two become one.
void BeamLearner::freeze() {
  for (; kept_.size() > kMostKept; kept_.pop_front()) frozen_.push_back(std::move(kept_.front().evidence));
  next_ = kept_.size();
  if (frozen_.size() <= std::size_t(options_.most_windows)) return;
  for (std::size_t i = 0; 2 * i < frozen_.size(); ++i) {
    WindowEvidence one = std::move(frozen_[2 * i]);
    frozen_[i] = 2 * i + 1 < frozen_.size() ? sum_of(std::move(one), frozen_[2 * i + 1]) : std::move(one);
  }
  frozen_.resize((frozen_.size() + 1) / 2);
}

}  // namespace tilth
