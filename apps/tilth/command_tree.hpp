// What the command line understands, as CLI11 knows it: for manual pages and for the completion of shells.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace tilth::app {

struct ArgumentInfo {
  std::vector<std::string> names;  ///< "-h", "--help"; of a positional argument its one name, as "SOURCE"
  std::string value;               ///< what stands for it in the help, as "TEXT REQUIRED"; empty: takes none
  std::string meaning;
  std::vector<std::string> choices;  ///< all that it may be; empty: anything, and most often a file
};

struct CommandInfo {
  std::string name;  ///< with those above it: "tilth map info"
  std::string meaning, footer;
  std::vector<ArgumentInfo> options, positionals;
  std::vector<CommandInfo> commands;  ///< in the order in which the help lists them

  /// The last word of the name: what is typed.
  std::string word() const { return name.substr(name.rfind(' ') + 1); }
};

/// The program `app` with all commands that its help lists. Choices are those that the help writes as "a | b".
CommandInfo command_tree(const CLI::App& app);

/// Gives choices to every argument of one of these names, with and without dashes: "pipeline" is --pipeline and
/// PIPELINE.
void give_choices(CommandInfo& command, const std::string& name, const std::vector<std::string>& choices);

/// The command itself and all below it, depth first.
std::vector<const CommandInfo*> all_commands(const CommandInfo& command);

}  // namespace tilth::app
