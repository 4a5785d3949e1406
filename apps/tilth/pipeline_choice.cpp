#include "pipeline_choice.hpp"

#include <tilth/core/error.hpp>
#include <tilth/io/config_file.hpp>
#include <tilth/odometry/make_odometry.hpp>

namespace tilth::app {
namespace {

/// Takes the values whose keys begin with `prefix` out of `values`.
OptionValues taken(const std::string& prefix, OptionValues& values) {
  OptionValues some;
  for (auto it = values.lower_bound(prefix); it != values.end() && it->first.starts_with(prefix);)
    some.insert(values.extract(it++));
  return some;
}

}  // namespace

OptionValues parse_settings(const std::vector<std::string>& settings) {
  OptionValues values;
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos || equals == 0) throw Error("--set " + setting, "is no key=value");
    values[setting.substr(0, equals)] = setting.substr(equals + 1);
  }
  return values;
}

PipelineChoice choose_pipeline(const OptionArguments& arguments) {
  PipelineChoice choice{pipelines().front().name, {}, {}, {}};
  if (!arguments.config.empty()) choice.values = read_config(arguments.config);
  if (const auto named = choice.values.extract("pipeline")) choice.name = named.mapped();
  if (!arguments.pipeline.empty()) choice.name = arguments.pipeline;
  for (auto& [key, value] : parse_settings(arguments.settings)) choice.values[key] = value;
  choice.loop = taken("loop.", choice.values);
  choice.localize = taken("localize.", choice.values);
  return choice;
}

}  // namespace tilth::app
