#include "shell_completion.hpp"

namespace tilth::app {
namespace {

/// Between single quotes.
std::string in_quotes(const std::string& text) {
  std::string out(1, '\'');
  for (const char c : text) {
    if (c == '\'' || c == '\\') out += '\\';
    out += c;
  }
  out += '\'';
  return out;
}

std::string choices_of(const ArgumentInfo& argument) {
  std::string words;
  for (const std::string& choice : argument.choices) words += (words.empty() ? "" : " ") + choice;
  return in_quotes(words);
}

std::string option_line(const std::string& where, const ArgumentInfo& option) {
  std::string line = where;
  for (const std::string& name : option.names) {
    const bool is_long = name.starts_with("--");
    line.append(is_long ? " -l " : " -s ").append(name, is_long ? 2 : 1);
  }
  if (!option.value.empty()) line += option.choices.empty() ? " -r -F" : " -x -a " + choices_of(option);
  return line + " -d " + in_quotes(option.meaning) + "\n";
}

std::string lines_of(const std::string& program, const CommandInfo& command) {
  const std::string where = "complete -c " + program + " -n " + in_quotes("__" + program + "_at " + command.name);
  std::string text;
  for (const CommandInfo& below : command.commands)
    text += where + " -f -a " + below.word() + " -d " + in_quotes(below.meaning) + "\n";
  for (const ArgumentInfo& option : command.options) text += option_line(where, option);
  for (const ArgumentInfo& argument : command.positionals) {
    if (!argument.choices.empty()) text += where + " -a " + choices_of(argument) + "\n";
  }
  return text;
}

}  // namespace

std::string fish_completion(const CommandInfo& program) {
  std::string known, lines;
  for (const CommandInfo* command : all_commands(program)) {
    known.append(" ").append(in_quotes(command->name));
    lines += lines_of(program.name, *command);
  }
  return "# Completion of " + program.name + " for fish.\nfunction __" + program.name +
         "_at # whether the command line so far stands at this command\n    set -l at " + program.name +
         "\n    for word in (commandline -opc)[2..-1]\n        if contains -- \"$at $word\"" + known +
         "\n            set at \"$at $word\"\n        end\n    end\n    test \"$at\" = \"$argv\"\nend\n" + lines;
}

}  // namespace tilth::app
