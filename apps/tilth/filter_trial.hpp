// An outlier filter tried on labelled scans, with the features that a pipeline would take before and after it.
#pragma once

#include <span>

#include <tilth/evaluation/filter_score.hpp>
#include <tilth/odometry/improved_floam.hpp>

namespace tilth::app {

/// The score over all scans of the pipeline's first stages: crop, neighbours, outlier removal and choice of features.
/// The same for any number of threads.
FilterScore try_filter(std::span<const LabelledCloud> scans, const ImprovedFloamOptions& options);

/// The options that matter here: ranges, `outliers` and `features`.
std::vector<OptionInfo> describe_filter(const ImprovedFloamOptions& options);

}  // namespace tilth::app
