// The pipelines by name: the only place that knows them all.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <tilth/core/options.hpp>
#include <tilth/odometry/odometry.hpp>

namespace tilth {

struct PipelineInfo {
  std::string name, summary;
};

/// Every pipeline, the default one first.
std::vector<PipelineInfo> pipelines();

/// Throws Error on an unknown name, option or bound.
std::unique_ptr<Odometry> make_odometry(const std::string& name, const OptionValues& values = {});

/// The options of a pipeline with `values` set, for `tilth config`, documents and summaries. Throws like make_odometry.
std::vector<OptionInfo> describe_odometry(const std::string& name, const OptionValues& values);

}  // namespace tilth
