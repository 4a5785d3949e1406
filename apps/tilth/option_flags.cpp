#include "option_flags.hpp"

#include <algorithm>

#include <CLI/CLI.hpp>

namespace tilth::app {

std::string flag_of(std::string key) {
  std::replace(key.begin(), key.end(), '_', '-');
  return "--" + key;
}

void add_option_flags(CLI::App& command, std::span<const OptionInfo> options, OptionValues& values) {
  for (const OptionInfo& option : options) {
    const auto set = [&values, key = option.key](const std::string& value) { values[key] = value; };
    if (option.allowed == "true | false") {
      command.add_flag_callback(
          flag_of(option.key), [set] { set("true"); }, option.meaning);
    } else {
      command.add_option_function<std::string>(flag_of(option.key), set, "[" + option.unit + "] " + option.meaning)
          ->option_text(option.allowed + " (" + option.value + ")");
    }
  }
}

}  // namespace tilth::app
