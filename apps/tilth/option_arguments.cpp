#include "option_arguments.hpp"

#include <tilth/io/config_file.hpp>
#include <tilth/odometry/make_odometry.hpp>

namespace tilth::app {

void add_setting_arguments(CLI::App& command, OptionArguments& arguments) {
  command.add_option("--config", arguments.config, "YAML file of options");
  command.add_option("--set", arguments.settings, "key=value: an option, stronger than the file (see `tilth config`)")
      ->allow_extra_args(false);
}

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
  PipelineChoice choice{pipelines().front().name, {}};
  if (!arguments.config.empty()) choice.values = read_config(arguments.config);
  if (const auto named = choice.values.extract("pipeline")) choice.name = named.mapped();
  if (!arguments.pipeline.empty()) choice.name = arguments.pipeline;
  for (auto& [key, value] : parse_settings(arguments.settings)) choice.values[key] = value;
  return choice;
}

}  // namespace tilth::app
