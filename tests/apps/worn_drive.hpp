// A short drive of a simulated sensor whose beams err, and what runs make of it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "program.hpp"
#include <tilth/core/trajectory.hpp>
#include <tilth/evaluation/evaluate.hpp>
#include <tilth/io/trajectory_file.hpp>

namespace tilth::app {

class WornDrive : public testing::Test {
 protected:
  std::string in(const std::string& name) const { return (folder_ / name).string(); }

  void simulate(const std::string& beams) const {
    ASSERT_EQ(tilth({"simulate", "corridor_fast", "--duration", "30", "--beams", beams, "--set", "columns=900", "--out",
                     in("drive"), "--quiet"})
                  .exit_code,
              0);
  }

  /// In one pass, unless it is told how beams are to be taken.
  Trajectory run(const std::string& out, const std::vector<std::string>& more = {"--keep-beams"}) const {
    std::vector<std::string> arguments{"run", in("drive"), "--out", in(out)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = tilth(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return read_tum(folder_ / out / "trajectory.tum");
  }

  double ape(const Trajectory& estimate) const {
    EvaluationOptions options;
    options.align = Alignment::se3, options.association.interpolate = true;
    return evaluate(read_tum(folder_ / "drive" / "truth.tum"), estimate, options).ape.translation.rmse;
  }

  void expect_refused(const Outcome& outcome, const std::vector<std::string>& words, int exit_code = 1) const {
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    for (const std::string& word : words)
      EXPECT_NE(outcome.err.find(word), std::string::npos) << word << ": " << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "beams.yaml"));
  }

  TemporaryFolder folder_;
};

}  // namespace tilth::app
