#include "command_tree.hpp"

#include <algorithm>
#include <cctype>
#include <sstream>

#include <CLI/CLI.hpp>

namespace tilth::app {
namespace {

/// "both | strongest | farthest (both)" -> both, strongest, farthest; nothing where no bar stands.
std::vector<std::string> choices_in(const std::string& value) {
  if (value.find(" | ") == std::string::npos) return {};
  std::vector<std::string> choices;
  std::istringstream words(value);
  for (std::string word; words >> word && word.front() != '(';) {
    if (word != "|") choices.push_back(word);
  }
  return choices;
}

ArgumentInfo argument_of(const CLI::Option& option) {
  ArgumentInfo info;
  if (option.get_positional()) info.names.push_back(option.get_name(true));
  for (const std::string& name : option.get_snames()) info.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) info.names.push_back("--" + name);
  if (option.get_items_expected_max() > 0) info.value = CLI::Formatter().make_option_opts(&option);
  info.value.erase(0, info.value.find_first_not_of(' '));
  info.meaning = option.get_description();
  info.choices = choices_in(info.value);
  return info;
}

CommandInfo command_of(const CLI::App& app, const std::string& above) {
  CommandInfo info{above + app.get_name(), app.get_description(), app.get_footer(), {}, {}, {}};
  for (const CLI::Option* option : app.get_options())
    (option->get_positional() ? info.positionals : info.options).push_back(argument_of(*option));
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    info.commands.push_back(command_of(*command, info.name + " "));
  return info;
}

/// "--max-scans" -> "max-scans", "SOURCE" -> "source".
std::string bare(std::string name) {
  name.erase(0, name.find_first_not_of('-'));
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return name;
}

}  // namespace

CommandInfo command_tree(const CLI::App& app) {
  return command_of(app, "");
}

void give_choices(CommandInfo& command, const std::string& name, const std::vector<std::string>& choices) {
  for (std::vector<ArgumentInfo>* arguments : {&command.options, &command.positionals}) {
    for (ArgumentInfo& argument : *arguments) {
      if (bare(argument.names.back()) == name) argument.choices = choices;
    }
  }
  for (CommandInfo& below : command.commands) give_choices(below, name, choices);
}

std::vector<const CommandInfo*> all_commands(const CommandInfo& command) {
  std::vector<const CommandInfo*> all{&command};
  for (const CommandInfo& below : command.commands) {
    const auto more = all_commands(below);
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

}  // namespace tilth::app
