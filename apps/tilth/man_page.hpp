// Pages for man(1).
#pragma once

#include <string>

#include "command_tree.hpp"

namespace tilth::app {

/// The page of one command in the man macros of roff, as tilth-run.1; `program` is the tree that it is part of.
std::string man_page(const CommandInfo& program, const CommandInfo& command, const std::string& version);

/// "tilth map info" -> "tilth-map-info".
std::string man_name(const CommandInfo& command);

}  // namespace tilth::app
