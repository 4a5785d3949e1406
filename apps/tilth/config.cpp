// tilth config: every option of a pipeline with its default, unit, bounds and meaning.
#include <cstdio>
#include <memory>

#include "commands.hpp"
#include "option_arguments.hpp"
#include "option_listing.hpp"
#include <tilth/odometry/make_odometry.hpp>

namespace tilth::app {
namespace {

struct ConfigArguments {
  OptionArguments options;
  bool yaml = false, markdown = false;
};

std::string listing(const ConfigArguments& arguments, const PipelineChoice& choice) {
  const std::vector<OptionInfo> options = describe_odometry(choice.name, choice.values);
  if (arguments.yaml) return option_yaml(choice.name, options);
  if (arguments.markdown) return option_markdown(choice.name, options);
  return option_table(choice.name, options);
}

/// One pipeline where one is named, else all of them.
int print_options(const ConfigArguments& arguments) {
  const PipelineChoice choice = choose_pipeline(arguments.options);
  const bool chosen = arguments.yaml || !arguments.options.pipeline.empty() || !arguments.options.config.empty();
  std::string text;
  if (chosen) {
    text = listing(arguments, choice);
  } else {
    for (const PipelineInfo& pipeline : pipelines()) {
      text += (text.empty() ? "" : "\n") + listing(arguments, {pipeline.name, choice.values});
    }
  }
  std::fputs(text.c_str(), stdout);
  return 0;
}

}  // namespace

void add_config(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("config", "Show the options of a pipeline, or of all");
  const auto arguments = std::make_shared<ConfigArguments>();
  command->add_option("PIPELINE", arguments->options.pipeline, "see `tilth pipelines`; default: all");
  add_setting_arguments(*command, arguments->options);
  CLI::Option* yaml = command->add_flag("--yaml", arguments->yaml, "as a file for --config");
  command->add_flag("--markdown", arguments->markdown, "as a table for documents")->excludes(yaml);
  command->callback([arguments, &exit_code] { exit_code = print_options(*arguments); });
}

}  // namespace tilth::app
