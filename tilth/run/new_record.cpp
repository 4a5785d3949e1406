#include <algorithm>
#include <iterator>

#include <tilth/odometry/make_odometry.hpp>
#include <tilth/run/machine.hpp>
#include <tilth/run/new_record.hpp>

namespace tilth {

RunRecord new_record(const std::string& source, const std::string& pipeline, const OptionValues& values) {
  RunRecord record;
  record.version = TILTH_VERSION;
  record.source = source;
  record.pipeline = pipeline;
  record.machine = machine_name();
  record.options = describe_odometry(pipeline, values);
  record.defaults = describe_odometry(pipeline, {});
  return record;
}

void add_options(std::vector<OptionInfo> options, std::vector<OptionInfo> defaults, RunRecord& record) {
  std::move(options.begin(), options.end(), std::back_inserter(record.options));
  std::move(defaults.begin(), defaults.end(), std::back_inserter(record.defaults));
}

}  // namespace tilth
