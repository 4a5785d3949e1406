// A struct of options as flags of a command: "rpe_delta" becomes --rpe-delta.
#pragma once

#include <span>
#include <string>

#include <tilth/core/options.hpp>

namespace CLI {
class App;
}

namespace tilth::app {

/// "rpe_delta" -> "--rpe-delta".
std::string flag_of(std::string key);

/// Adds a flag for every option; what is given on the command line goes to `values`, which must outlive the command.
void add_option_flags(CLI::App& command, std::span<const OptionInfo> options, OptionValues& values);

}  // namespace tilth::app
