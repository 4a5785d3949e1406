// What filters did to labelled scans, as tables for people, as CSV and as JSON. docs/outlier_removal.md says what every
// figure counts.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <tilth/core/options.hpp>
#include <tilth/evaluation/filter_score.hpp>

namespace tilth {

/// One filter on one recording.
struct FilterTrial {
  std::string recording;  ///< scene, or folder
  std::vector<OptionInfo> options;
  FilterScore score;
};

/// Every count of one trial, and what section 2.3 of the paper claims beside it.
std::string filter_table(const FilterTrial& trial);

/// One line a trial: the values of the options `columns`, then the shares that the claims are about, in percent.
std::string filter_sweep_table(std::span<const FilterTrial> trials, std::span<const std::string> columns);

/// One line a trial, every option and every figure.
std::string filter_csv(std::span<const FilterTrial> trials);

/// A JSON array of trials: "recording", "options", and every figure as a share from 0 to 1 or a count.
std::string filter_json(std::span<const FilterTrial> trials);

}  // namespace tilth
