#include "source_flags.hpp"

#include <CLI/CLI.hpp>

#include "option_flags.hpp"
#include <tilth/sources/describe_source.hpp>

namespace tilth::app {

void add_source_flags(CLI::App& command, SourceOptions& source) {
  const SourceMeanings meanings;
  command.add_option("--topic", source.topic, meanings.topic);
  command.add_option("--frame", source.frame, meanings.frame);
  command.add_option("--rate", source.rate, std::string("[Hz] ") + meanings.rate)->check(CLI::PositiveNumber);
  add_option_flags(command, source_value_options(), source.values);
}

}  // namespace tilth::app
