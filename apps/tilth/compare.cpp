// tilth compare: pipelines, and programs of others, on the same scans; the tables of the paper over several seeds.
#include <cstdio>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>

#include "commands.hpp"
#include "compare_peers.hpp"
#include "number_list.hpp"
#include "run_matrix.hpp"
#include <tilth/core/error.hpp>
#include <tilth/odometry/make_odometry.hpp>
#include <tilth/study/comparison.hpp>

namespace tilth::app {
namespace {

/// All that there are.
std::string every_pipeline() {
  std::string names;
  for (const PipelineInfo& pipeline : pipelines()) names += (names.empty() ? "" : ",") + pipeline.name;
  return names;
}

struct CompareArguments {
  MatrixArguments matrix;
  std::string pipelines = every_pipeline(), peers, base;
};

std::vector<Method> methods_of(const CompareArguments& arguments, const Peers& peers) {
  std::vector<Method> methods;
  for (const std::string& name : parse_word_list("--pipelines", arguments.pipelines))
    methods.push_back(pipeline_method(name, arguments.matrix));
  methods.insert(methods.end(), peers.methods.begin(), peers.methods.end());
  return methods;
}

std::string base_of(const CompareArguments& arguments, const std::vector<Method>& methods) {
  if (arguments.base.empty()) return methods.back().label;
  std::string names;
  for (const Method& method : methods) {
    if (method.label == arguments.base) return method.label;
    names += (names.empty() ? "" : ", ") + method.label;
  }
  throw Error("--base " + arguments.base, "is not compared; there are " + names);
}

int compare(const CompareArguments& arguments) {
  const Peers peers = find_peers(arguments.peers, arguments.matrix);
  const std::vector<Method> methods = methods_of(arguments, peers);
  Comparison comparison;
  comparison.version = TILTH_VERSION;
  comparison.base = base_of(arguments, methods);
  comparison.judging = judging_of(arguments.matrix);
  comparison.skipped = peers.skipped;
  comparison.remarks = peers.used;
  const std::vector<MatrixRun> runs = plan_runs(arguments.matrix, methods);
  if (const std::optional<int> exit_code = carry_out(arguments.matrix, runs)) return *exit_code;
  comparison.runs = judge_runs(arguments.matrix, runs);
  write_comparison(arguments.matrix.out, comparison);
  std::fputs(table_text(summary_table(comparison)).c_str(), stdout);
  return 0;
}

}  // namespace

void add_compare(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("compare", "Hold pipelines against each other on recordings with truth");
  const auto arguments = std::make_shared<CompareArguments>();
  command->add_option("--pipelines", arguments->pipelines, "a,b,c; NAME[:key=value]... or a YAML file (all)");
  command->add_option("--base", arguments->base, "method that the others' mean errors are held against (the last)");
  command->add_option("--peers", arguments->peers,
                      "odometries of others from PyPI: kiss_icp,genz_icp,mad_icp,small_gicp");
  add_matrix_arguments(*command, arguments->matrix);
  command->callback([arguments, &exit_code] { exit_code = compare(*arguments); });
}

}  // namespace tilth::app
