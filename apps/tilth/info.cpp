// tilth info: what a recording holds, how it is understood, and what a newcomer should know about it.
#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "commands.hpp"
#include "console.hpp"
#include "interrupt.hpp"
#include "source_flags.hpp"
#include "truth_flags.hpp"
#include <tilth/run/truth_file.hpp>
#include <tilth/sources/open_source.hpp>
#include <tilth/sources/scan_survey.hpp>

namespace tilth::app {
namespace {

constexpr std::size_t kMostSkipped = 10;

struct InfoArguments {
  std::string source, truth, calibration;
  SourceOptions input;
  std::size_t max_scans = 0;  // zero: all
};

void print(const std::string& title, const std::vector<std::string>& lines) {
  if (lines.empty()) return;
  std::printf("%s\n", title.c_str());
  for (const std::string& line : lines) std::printf("  %s\n", line.c_str());
}

std::vector<std::string> skipped_lines(const ScanSource& source) {
  std::vector<std::string> lines;
  for (const SkippedScan& skipped : source.skipped()) {
    if (lines.size() == kMostSkipped) {
      lines.push_back("and " + std::to_string(source.skipped().size() - kMostSkipped) + " more");
      break;
    }
    lines.push_back(skipped.where + ": " + skipped.what);
  }
  return lines;
}

int info(const InfoArguments& arguments) {
  std::optional<TruthFile> truth;
  if (!arguments.truth.empty()) truth = read_truth(arguments.truth, arguments.calibration);
  const std::unique_ptr<ScanSource> source = open_source(arguments.source, stopped_by_signals(arguments.input));
  remember_interrupts();
  Console console(false);
  ScanSurvey survey;
  while ((arguments.max_scans == 0 || survey.scans() < arguments.max_scans) && interrupted() == 0) {
    const std::optional<Scan> scan = source->next();
    if (!scan) break;
    survey.add(*scan);
    console.progress(survey.scans(), source->size());
  }
  console.clear_progress();
  print("What is in " + arguments.source, source->contents());
  print("How it is understood", source->decisions());
  if (truth) print("The truth", truth_lines(*truth));
  print("What was counted", survey_lines(survey));
  print("Noticed", source->notices());
  print("Left out", skipped_lines(*source));
  const std::vector<std::string> warnings = survey_warnings(survey);
  print("Warnings", warnings.empty() ? std::vector<std::string>{"none"} : warnings);
  return survey.scans() == 0 ? 1 : 0;
}

}  // namespace

void add_info(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("info", "Tell what is in a recording and how it is understood");
  const auto arguments = std::make_shared<InfoArguments>();
  command->add_option("SOURCE", arguments->source, "as `tilth run` takes it")->required();
  add_source_flags(*command, arguments->input);
  add_truth_flags(*command, "to look at too", arguments->truth, arguments->calibration);
  command->add_option("--max-scans", arguments->max_scans, "stop after so many scans");
  command->callback([arguments, &exit_code] { exit_code = info(*arguments); });
}

}  // namespace tilth::app
