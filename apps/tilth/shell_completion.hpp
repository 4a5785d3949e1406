// Scripts by which a shell completes the command line of a program.
#pragma once

#include <string>

#include "command_tree.hpp"

namespace tilth::app {

/// Each is to be sourced by its shell, or put where that looks for completions; docs/installing.md says where. After an
/// option that takes a value its choices are offered, files where it has none; elsewhere commands, options and files.
std::string bash_completion(const CommandInfo& program);
std::string zsh_completion(const CommandInfo& program);
std::string fish_completion(const CommandInfo& program);

}  // namespace tilth::app
