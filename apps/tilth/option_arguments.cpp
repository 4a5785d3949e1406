#include "option_arguments.hpp"

#include <algorithm>
#include <cctype>

#include <CLI/CLI.hpp>

namespace tilth::app {
namespace {

bool is_setting(const std::string& argument) {
  const auto in_key = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '.'; };
  const auto equals = std::find_if_not(argument.begin(), argument.end(), in_key);
  return equals != argument.begin() && equals != argument.end() && *equals == '=';
}

}  // namespace

void add_settings(CLI::App& command, std::vector<std::string>& settings, const std::string& help) {
  command.add_option("--set", settings, help)->allow_extra_args(false)->option_text("key=value ...");
}

void add_setting_arguments(CLI::App& command, OptionArguments& arguments) {
  command.add_option("--config", arguments.config, "YAML file of options");
  add_settings(command, arguments.settings, "options, stronger than the file (see `tilth config`)");
}

std::vector<std::string> spread_settings(std::span<const char* const> arguments) {
  std::vector<std::string> spread;
  bool after_setting = false;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string argument = arguments[i];
    const bool named = i > 0 && std::string("--set") == arguments[i - 1];
    if (after_setting && !named && is_setting(argument)) spread.push_back("--set");
    after_setting = named || argument.starts_with("--set=") || (after_setting && is_setting(argument));
    spread.push_back(argument);
  }
  return spread;
}

}  // namespace tilth::app
