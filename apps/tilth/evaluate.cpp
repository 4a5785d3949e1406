// tilth evaluate: an estimated trajectory against the true one.
#include <cstdio>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "commands.hpp"
#include "option_flags.hpp"
#include "truth_flags.hpp"
#include <tilth/evaluation/evaluate.hpp>
#include <tilth/io/output_file.hpp>
#include <tilth/io/pose_file.hpp>
#include <tilth/run/evaluation_report.hpp>
#include <tilth/run/truth_file.hpp>

namespace tilth::app {
namespace {

struct EvaluateArguments {
  std::string truth, estimate, calibration, json;
  OptionValues values;
};

void evaluate_files(const EvaluateArguments& arguments) {
  const auto options = with<EvaluationOptions>(arguments.values);
  const TruthFile truth = read_truth(arguments.truth, arguments.calibration);
  const Evaluation evaluation = judge(truth, read_pose_file(arguments.estimate), options);
  if (!arguments.json.empty()) write_text(arguments.json, evaluation_json(evaluation));
  std::fputs(evaluation_table(evaluation).c_str(), stdout);
}

}  // namespace

void add_evaluate(CLI::App& app, int&) {
  const auto arguments = std::make_shared<EvaluateArguments>();
  CLI::App* command = app.add_subcommand("evaluate", "Compare a trajectory with the truth: APE, RPE, KITTI segments");
  command
      ->add_option("TRUTH", arguments->truth,
                   "true trajectory: TUM, KITTI poses, or a table whose header names its columns")
      ->required();
  command->add_option("ESTIMATE", arguments->estimate, "trajectory to judge, likewise")->required();
  add_option_flags(*command, describe(EvaluationOptions{}), arguments->values);
  add_calibration_flag(*command, arguments->calibration);
  command->add_option("--json", arguments->json, "file to write every statistic to, as JSON");
  command->callback([arguments] { evaluate_files(*arguments); });
}

}  // namespace tilth::app
