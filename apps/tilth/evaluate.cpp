// tilth evaluate: an estimated trajectory against the true one.
#include <cstdio>
#include <memory>
#include <string>

#include "commands.hpp"
#include "option_flags.hpp"
#include <tilth/evaluation/evaluate.hpp>
#include <tilth/io/output_file.hpp>
#include <tilth/io/pose_file.hpp>
#include <tilth/run/evaluation_report.hpp>

namespace tilth::app {
namespace {

struct EvaluateArguments {
  std::string truth, estimate, json;
  OptionValues values;
};

void evaluate_files(const EvaluateArguments& arguments) {
  const auto options = with<EvaluationOptions>(arguments.values);
  const PoseFile truth = read_pose_file(arguments.truth), estimate = read_pose_file(arguments.estimate);
  const auto judge = truth.has_stamps && estimate.has_stamps ? &evaluate : &evaluate_by_index;
  const Evaluation evaluation = judge(truth.trajectory, estimate.trajectory, options);
  if (!arguments.json.empty()) write_text(arguments.json, evaluation_json(evaluation));
  std::fputs(evaluation_table(evaluation).c_str(), stdout);
}

}  // namespace

void add_evaluate(CLI::App& app, int&) {
  const auto arguments = std::make_shared<EvaluateArguments>();
  CLI::App* command = app.add_subcommand("evaluate", "Compare a trajectory with the truth: APE, RPE, KITTI segments");
  command->add_option("TRUTH", arguments->truth, "true trajectory: TUM, or KITTI poses")->required();
  command->add_option("ESTIMATE", arguments->estimate, "trajectory to judge: TUM, or KITTI poses")->required();
  add_option_flags(*command, describe(EvaluationOptions{}), arguments->values);
  command->add_option("--json", arguments->json, "file to write every statistic to, as JSON");
  command->callback([arguments] { evaluate_files(*arguments); });
}

}  // namespace tilth::app
