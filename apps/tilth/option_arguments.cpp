#include "option_arguments.hpp"

#include <algorithm>
#include <cctype>

#include <CLI/CLI.hpp>

#include <tilth/core/error.hpp>
#include <tilth/io/config_file.hpp>
#include <tilth/odometry/make_odometry.hpp>

namespace tilth::app {
namespace {

bool is_setting(const std::string& argument) {
  const auto in_key = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '.'; };
  const auto equals = std::find_if_not(argument.begin(), argument.end(), in_key);
  return equals != argument.begin() && equals != argument.end() && *equals == '=';
}

/// Takes the values whose keys begin with `prefix` out of `values`.
OptionValues taken(const std::string& prefix, OptionValues& values) {
  OptionValues some;
  for (auto it = values.lower_bound(prefix); it != values.end() && it->first.starts_with(prefix);)
    some.insert(values.extract(it++));
  return some;
}

}  // namespace

void add_settings(CLI::App& command, std::vector<std::string>& settings, const std::string& help) {
  command.add_option("--set", settings, help)->allow_extra_args(false)->option_text("key=value ...");
}

void add_setting_arguments(CLI::App& command, OptionArguments& arguments) {
  command.add_option("--config", arguments.config, "YAML file of options");
  add_settings(command, arguments.settings, "options, stronger than the file (see `tilth config`)");
}

std::vector<std::string> spread_settings(std::span<const char* const> arguments) {
  std::vector<std::string> spread;
  bool after_setting = false;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string argument = arguments[i];
    const bool named = i > 0 && std::string("--set") == arguments[i - 1];
    if (after_setting && !named && is_setting(argument)) spread.push_back("--set");
    after_setting = named || argument.starts_with("--set=") || (after_setting && is_setting(argument));
    spread.push_back(argument);
  }
  return spread;
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
