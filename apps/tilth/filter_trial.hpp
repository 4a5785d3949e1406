// An outlier filter tried on labelled scans, with the features that a pipeline would take before and after it.
#pragma once

#include <span>

#include <tilth/evaluation/filter_score.hpp>
#include <tilth/odometry/improved_floam.hpp>

namespace tilth::app {

/// The score over all scans: crop, neighbours, outlier removal, and features chosen by the corrected curvature of each
/// point's nearest neighbours. The same for any number of threads.
FilterScore try_filter(std::span<const LabelledCloud> scans, const ImprovedFloamOptions& options);

/// The options that matter here: ranges, `outliers` and `features`.
std::vector<OptionInfo> describe_filter(const ImprovedFloamOptions& options);

}  // namespace tilth::app
