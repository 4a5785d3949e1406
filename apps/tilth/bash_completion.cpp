#include "shell_completion.hpp"

namespace tilth::app {
namespace {

std::string joined(const std::vector<std::string>& words, const std::string& between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

/// What may stand where no option's value is due, but for files: commands, or what positional arguments may be.
std::vector<std::string> words_of(const CommandInfo& command) {
  std::vector<std::string> words;
  for (const CommandInfo& below : command.commands) words.push_back(below.word());
  for (const ArgumentInfo& argument : command.positionals)
    words.insert(words.end(), argument.choices.begin(), argument.choices.end());
  return words;
}

std::vector<std::string> names_of(const CommandInfo& command) {
  std::vector<std::string> names;
  for (const ArgumentInfo& option : command.options)
    names.insert(names.end(), option.names.begin(), option.names.end());
  return names;
}

/// A branch for each option that takes a value; files are what bash itself offers where nothing is.
std::string value_branches(const CommandInfo& command) {
  std::string text;
  for (const ArgumentInfo& option : command.options) {
    if (option.value.empty()) continue;
    std::vector<std::string> patterns;
    for (const std::string& name : option.names) patterns.push_back("'" + command.name + " " + name + "'");
    text += "    " + joined(patterns, " | ") + ") words='" + joined(option.choices, " ") + "' ;;\n";
  }
  return text;
}

}  // namespace

std::string bash_completion(const CommandInfo& program) {
  std::string known, values, words;
  for (const CommandInfo* command : all_commands(program)) {
    if (command != &program) known += (known.empty() ? "" : " | ") + ("'" + command->name + "'");
    values += value_branches(*command);
    words += "    '" + command->name + "') names='" + joined(names_of(*command), " ") + "' words='" +
             joined(words_of(*command), " ") + "' ;;\n";
  }
  const std::string function = "_" + program.name;
  return "# Completion of " + program.name + " for bash.\n" + function + "() {\n" +
         "  local current=${COMP_WORDS[COMP_CWORD]} command=" + program.name + " word names='' words='' value=yes\n" +
         "  for word in \"${COMP_WORDS[@]:1:COMP_CWORD-1}\"; do\n    case \"$command $word\" in\n      " + known +
         ") command+=\" $word\" ;;\n    esac\n  done\n" + "  case \"$command ${COMP_WORDS[COMP_CWORD-1]}\" in\n" +
         values + "    *) value='' ;;\n  esac\n" + "  if [[ -z $value ]]; then\n    case $command in\n" + words +
         "    esac\n" + "    if [[ $current == -* ]]; then words=$names; fi\n  fi\n" +
         "  mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$current\")\n}\n" +
         "complete -o bashdefault -o default -F " + function + " " + program.name + "\n";
}

}  // namespace tilth::app
