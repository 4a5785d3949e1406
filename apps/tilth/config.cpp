// tilth config: every option of a pipeline with its default, unit, bounds and meaning.
#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>

#include "calibration_options.hpp"
#include "commands.hpp"
#include "option_arguments.hpp"
#include "option_listing.hpp"
#include <tilth/localization/localizer.hpp>
#include <tilth/odometry/make_odometry.hpp>
#include <tilth/slam/slam.hpp>

namespace tilth::app {
namespace {

struct ConfigArguments {
  OptionArguments options;
  bool yaml = false, markdown = false;
};

std::string listing(const ConfigArguments& arguments, const std::string& title,
                    const std::vector<OptionInfo>& options) {
  return arguments.markdown ? option_markdown(title, options) : option_table(title, options);
}

std::string file_for_config(const PipelineChoice& choice) {
  std::vector<OptionInfo> options = describe_odometry(choice.name, choice.values);
  const std::vector<OptionInfo> loop = describe(with<SlamOptions>(choice.loop));
  options.insert(options.end(), loop.begin(), loop.end());
  return option_yaml(choice.name, options);
}

/// One pipeline where one is named, else all of them; then what is common to all.
int print_options(const ConfigArguments& arguments) {
  PipelineChoice choice = choose_pipeline(arguments.options);
  const CalibrationOptions calibration = take_calibration_options(choice.values);
  const bool chosen = !arguments.options.pipeline.empty() || !arguments.options.config.empty();
  std::string text;
  if (arguments.yaml) {
    text = file_for_config(choice);
  } else {
    std::vector<std::string> names;
    for (const PipelineInfo& pipeline : pipelines()) names.push_back(pipeline.name);
    if (chosen) names = {choice.name};
    for (const std::string& name : names)
      text += listing(arguments, name, describe_odometry(name, choice.values)) + "\n";
    text += listing(arguments, "every pipeline, with --loop-closure", describe(with<SlamOptions>(choice.loop))) + "\n";
    text += listing(arguments, "tilth localize", describe(with<LocalizationOptions>(choice.localize))) + "\n";
    text += listing(arguments, "tilth calibrate", describe(calibration));
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
