#include <algorithm>

#include <tilth/run/stage_clock.hpp>

namespace tilth {

void StageClock::start() {
  std::fill(milliseconds_.begin(), milliseconds_.end(), 0.0);
  running_.reset();
  scan_ = Stopwatch();
}

void StageClock::begin(std::string_view stage) {
  end_stage();
  running_ = std::size_t(std::find(stages_.begin(), stages_.end(), stage) - stages_.begin());
  if (*running_ == stages_.size()) {
    stages_.emplace_back(stage);
    milliseconds_.push_back(0.0);
  }
  stage_ = Stopwatch();
}

double StageClock::stop() {
  end_stage();
  return scan_.milliseconds();
}

void StageClock::end_stage() {
  if (running_) milliseconds_[*running_] += stage_.milliseconds();
  running_.reset();
}

}  // namespace tilth
