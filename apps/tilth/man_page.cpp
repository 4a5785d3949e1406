#include "man_page.hpp"

#include <algorithm>
#include <cctype>

namespace tilth::app {
namespace {

/// Text that roff takes for text: backslashes and hyphens as they are, no line that begins as a request does.
std::string roff(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\') {
      out += "\\e";
    } else if (c == '-') {
      out += "\\-";
    } else if ((c == '.' || c == '\'') && (out.empty() || out.back() == '\n')) {
      out += std::string("\\&") + c;
    } else {
      out += c;
    }
  }
  return out;
}

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return char(std::toupper(c)); });
  return text;
}

std::string argument_text(const ArgumentInfo& argument) {
  std::string names;
  for (const std::string& name : argument.names) names += (names.empty() ? "\\fB" : ", \\fB") + roff(name) + "\\fR";
  const std::string value = roff(argument.value);
  return ".TP\n" + names + (value.empty() ? "" : " ") + value + "\n" + roff(argument.meaning) + "\n";
}

std::string section(const std::string& title, const std::vector<ArgumentInfo>& arguments) {
  if (arguments.empty()) return "";
  std::string text = ".SH " + title + "\n";
  for (const ArgumentInfo& argument : arguments) text += argument_text(argument);
  return text;
}

std::string synopsis(const CommandInfo& command) {
  std::string text = "\\fB" + roff(command.name) + "\\fR [\\fIOPTIONS\\fR]";
  for (const ArgumentInfo& argument : command.positionals) text += " \\fI" + roff(argument.names.front()) + "\\fR";
  return text + (command.commands.empty() ? "" : " \\fICOMMAND\\fR") + "\n";
}

std::string commands_section(const CommandInfo& command) {
  if (command.commands.empty()) return "";
  std::string text = ".SH COMMANDS\n";
  for (const CommandInfo& below : command.commands)
    text += ".TP\n\\fB" + roff(below.word()) + "\\fR\n" + roff(below.meaning) + ", see \\fB" + roff(man_name(below)) +
            "\\fR(1)\n";
  return text;
}

const char* const kExitStatus =
    ".SH EXIT STATUS\n"
    ".TP\n0\ndone\n.TP\n1\nbad input, option or output\n"
    ".TP\n3\ndone, but there is something to look at: the track was lost, a map is not good, no place was found\n"
    ".TP\n130, 143\ninterrupted; what was computed is written\n"
    ".TP\n101 to 127\nthe command line was not understood\n";

}  // namespace

std::string man_name(const CommandInfo& command) {
  std::string name = command.name;
  std::replace(name.begin(), name.end(), ' ', '-');
  return name;
}

std::string man_page(const CommandInfo& program, const CommandInfo& command, const std::string& version) {
  std::string text = ".TH " + upper(man_name(command)) + " 1 \"\" \"" + program.name + " " + version + "\"\n";
  text += ".SH NAME\n" + man_name(command) + " \\- " + roff(command.meaning) + "\n";
  text += ".SH SYNOPSIS\n" + synopsis(command);
  text += section("ARGUMENTS", command.positionals) + commands_section(command) + section("OPTIONS", command.options);
  if (!command.footer.empty()) text += ".SH MORE\n.nf\n" + roff(command.footer) + "\n.fi\n";
  text += kExitStatus;
  if (&command != &program) text += ".SH SEE ALSO\n\\fB" + program.name + "\\fR(1)\n";
  return text;
}

}  // namespace tilth::app
