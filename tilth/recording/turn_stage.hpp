// The scans that messages hold -> scans of whole turns, after the first messages told how they go together.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <tilth/recording/turns.hpp>

namespace tilth {

class TurnStage {
 public:
  /// `snapshots`: points have no times, and parts put together get none.
  explicit TurnStage(bool snapshots = false) : snapshots_(snapshots) {}

  std::vector<Scan> add(Scan message);  ///< turns that are whole; none while the first messages are collected
  std::vector<Scan> finish();           ///< at the end of the recording

  /// Of the messages; nothing before it is decided.
  const std::optional<TurnPlan>& plan() const { return plan_; }

  std::vector<std::string> notices() const;

 private:
  std::vector<Scan> decide();
  std::vector<Scan> turns_of(Scan message);

  bool snapshots_;
  std::vector<Scan> first_;
  std::optional<TurnPlan> plan_;
  std::optional<TurnAssembler> assembler_;
};

}  // namespace tilth
