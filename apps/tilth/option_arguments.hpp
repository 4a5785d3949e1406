// --config and --set: how the options of a pipeline are given on the command line.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "pipeline_choice.hpp"

namespace CLI {
class App;
}

namespace tilth::app {

/// Adds --set to a command: key=value, as often as wanted. `settings` must outlive it.
void add_settings(CLI::App& command, std::vector<std::string>& settings, const std::string& help);

/// Adds --config and --set to a command. `arguments` must outlive it.
void add_setting_arguments(CLI::App& command, OptionArguments& arguments);

/// The command line with a --set of its own before each of several settings: `--set a=1 b=2 room` becomes
/// `--set a=1 --set b=2 room`. A key has letters, digits, dots and underscores only, so that no path is taken for one.
std::vector<std::string> spread_settings(std::span<const char* const> arguments);

}  // namespace tilth::app
