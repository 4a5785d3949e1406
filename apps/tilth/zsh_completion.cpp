#include <algorithm>

#include "shell_completion.hpp"

namespace tilth::app {
namespace {

/// For a text between single quotes in which colons and brackets mean something.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\'') {
      out += "'\\''";
    } else {
      if (c == ':' || c == '[' || c == ']' || c == '\\') out += '\\';
      out += c;
    }
  }
  return out;
}

std::string function_of(const CommandInfo& command) {
  std::string name = "_" + command.name;
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

/// What is offered for a value: its choices, else files.
std::string action_of(const ArgumentInfo& argument) {
  if (argument.choices.empty()) return "_files";
  std::string words = "(";
  for (const std::string& choice : argument.choices) words.append(words.size() > 1 ? " " : "").append(escaped(choice));
  return words + ")";
}

std::string option_specs(const CommandInfo& command) {
  std::string text;
  for (const ArgumentInfo& option : command.options) {
    for (const std::string& name : option.names) {
      text += " \\\n    '*" + name + "[" + escaped(option.meaning) + "]";
      if (!option.value.empty()) text.append(":value:").append(action_of(option));
      text += "'";
    }
  }
  return text;
}

std::string command_list(const CommandInfo& command) {
  std::string text;
  for (const CommandInfo& below : command.commands)
    text += "        '" + escaped(below.word()) + ":" + escaped(below.meaning) + "'\n";
  return text;
}

/// The command, then what stands after it, which the function of that command completes.
std::string with_commands(const CommandInfo& command) {
  std::string branches;
  for (const CommandInfo& below : command.commands)
    branches += "        " + below.word() + ") " + function_of(below) + " ;;\n";
  return "  local state line\n  _arguments -C" + option_specs(command) +
         " \\\n    '1:command:->command' '*::argument:->argument'\n  case $state in\n    command)\n" +
         "      local -a commands=(\n" + command_list(command) +
         "      )\n      _describe command commands ;;\n    argument)\n      case $line[1] in\n" + branches +
         "      esac ;;\n  esac\n";
}

std::string with_positionals(const CommandInfo& command) {
  std::string text = "  _arguments" + option_specs(command);
  if (!command.positionals.empty()) {
    const ArgumentInfo& first = command.positionals.front();
    text += " \\\n    '*:" + escaped(first.names.front()) + ":" + action_of(first) + "'";
  }
  return text + "\n";
}

}  // namespace

std::string zsh_completion(const CommandInfo& program) {
  std::string text = "#compdef " + program.name + "\n";
  for (const CommandInfo* command : all_commands(program)) {
    text += function_of(*command) + "() {\n" +
            (command->commands.empty() ? with_positionals(*command) : with_commands(*command)) + "}\n";
  }
  const std::string function = function_of(program);
  return text + "if [ \"$funcstack[1]\" = " + function + " ]; then " + function + " \"$@\"; else compdef " + function +
         " " + program.name + "; fi\n";
}

}  // namespace tilth::app
