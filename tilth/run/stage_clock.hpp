// Measures the stages of a pipeline, which call out their names and never see a clock themselves.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tilth/run/stopwatch.hpp>

namespace tilth {

class StageClock {
 public:
  void start();                        ///< of a scan
  void begin(std::string_view stage);  ///< ends the stage before
  double stop();                       ///< ends the last stage; [ms] since start()

  const std::vector<std::string>& stages() const { return stages_; }         ///< in order of first appearance
  const std::vector<double>& milliseconds() const { return milliseconds_; }  ///< of each stage in this scan

 private:
  void end_stage();

  std::vector<std::string> stages_;
  std::vector<double> milliseconds_;
  std::optional<std::size_t> running_;
  Stopwatch scan_, stage_;
};

}  // namespace tilth
