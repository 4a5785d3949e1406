// The pipelines by name: the only place that knows them all.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <tilth/core/options.hpp>
#include <tilth/odometry/odometry.hpp>

namespace tilth {

class ExternalMotion;

struct PipelineInfo {
  std::string name, summary;
};

/// Every pipeline, the default one first.
std::vector<PipelineInfo> pipelines();

/// `external`: motions of another source (wheels, an IMU, another odometry), as a help where scans tell little; none
/// by default. Throws Error on an unknown name, option or bound, and on motions for a pipeline that has no use for
/// them.
std::unique_ptr<Odometry> make_odometry(const std::string& name, const OptionValues& values = {},
                                        const std::shared_ptr<const ExternalMotion>& external = {});

/// The options of a pipeline with `values` set, for `tilth config`, documents and summaries. Throws like make_odometry.
std::vector<OptionInfo> describe_odometry(const std::string& name, const OptionValues& values);

}  // namespace tilth
