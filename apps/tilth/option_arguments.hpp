// --config and --set: how the options of a pipeline are given on the command line.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <tilth/core/options.hpp>

namespace CLI {
class App;
}

namespace tilth::app {

struct OptionArguments {
  std::string pipeline;               ///< empty: what the file names, else the default
  std::string config;                 ///< YAML file; empty: none
  std::vector<std::string> settings;  ///< "key=value", stronger than the file
};

struct PipelineChoice {
  std::string name;
  OptionValues values;
  OptionValues loop;      ///< those that begin with "loop.", which are the same for every pipeline
  OptionValues localize;  ///< those that begin with "localize.", likewise
};

/// Adds --set to a command: key=value, as often as wanted. `settings` must outlive it.
void add_settings(CLI::App& command, std::vector<std::string>& settings, const std::string& help);

/// Adds --config and --set to a command. `arguments` must outlive it.
void add_setting_arguments(CLI::App& command, OptionArguments& arguments);

/// The command line with a --set of its own before each of several settings: `--set a=1 b=2 room` becomes
/// `--set a=1 --set b=2 room`. A key has letters, digits, dots and underscores only, so that no path is taken for one.
std::vector<std::string> spread_settings(std::span<const char* const> arguments);

/// What "key=value" says, the last one of a key. Throws Error on what is no key=value.
OptionValues parse_settings(const std::vector<std::string>& settings);

/// A configuration file may name its pipeline (`pipeline: improved_floam`); the command line is stronger. Throws Error
/// on a file that cannot be read and on a setting that is no key=value. Keys and bounds are checked by the pipeline.
PipelineChoice choose_pipeline(const OptionArguments& arguments);

}  // namespace tilth::app
