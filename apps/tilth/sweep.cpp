// tilth sweep: what the parameters of a pipeline do, each alone or all as a grid.
#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>

#include "commands.hpp"
#include "number_list.hpp"
#include "option_arguments.hpp"
#include "run_matrix.hpp"
#include <tilth/core/error.hpp>
#include <tilth/odometry/make_odometry.hpp>
#include <tilth/sources/simulated_source.hpp>
#include <tilth/study/sweep.hpp>

namespace tilth::app {
namespace {

constexpr const char* kFiltered = "improved_floam";  // the pipeline whose filter `tilth score-filter` judges
constexpr std::size_t kMostSettings = 10000;

struct SweepArguments {
  MatrixArguments matrix;
  std::string pipeline = kFiltered;
  std::vector<std::string> parameters;  ///< "key=a,b,c"
  bool grid = false;
  int score_every = 50;
};

struct Parameter {
  std::string key;
  std::vector<std::string> values;
};

using Settings = std::vector<std::string>;  // "key=value"

std::vector<Parameter> parameters_of(const SweepArguments& arguments) {
  std::vector<Parameter> parameters;
  for (const std::string& text : arguments.parameters) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0) throw Error("--param " + text, "is no key=value,value,...");
    parameters.push_back({text.substr(0, equals), parse_word_list("--param", text.substr(equals + 1))});
  }
  return parameters;
}

/// The pipeline as it is, then with each value of each parameter.
std::vector<Settings> each_alone(const std::vector<Parameter>& parameters) {
  std::vector<Settings> all{{}};
  for (const Parameter& parameter : parameters) {
    for (const std::string& value : parameter.values) all.push_back({parameter.key + "=" + value});
  }
  return all;
}

std::vector<Settings> as_grid(const std::vector<Parameter>& parameters) {
  std::vector<Settings> all{{}};
  for (const Parameter& parameter : parameters) {
    std::vector<Settings> more;
    for (const Settings& settings : all) {
      for (const std::string& value : parameter.values) {
        more.push_back(settings);
        more.back().push_back(parameter.key + "=" + value);
      }
    }
    if (more.size() > kMostSettings) throw Error("--grid", "makes more than 10000 settings of the parameters");
    all = std::move(more);
  }
  return all;
}

/// A run with these settings; its filter judged as well, where it has one and the scans have labels.
Method method_of(const SweepArguments& arguments, const Settings& settings) {
  std::string name = arguments.pipeline;
  for (const std::string& setting : settings) name += ":" + setting;
  return pipeline_method(name, arguments.matrix);
}

Command score_command(const SweepArguments& arguments, const Settings& settings) {
  Command score{"tilth",  "score-filter",    "{scans}", "--every", std::to_string(arguments.score_every),
                "--json", "{out}/score.json"};
  for (const auto& list : {arguments.matrix.settings, settings}) {
    for (const std::string& setting : list) score.insert(score.end(), {"--set", setting});
  }
  return score;
}

/// All sources are simulated: only they have labels.
bool labelled(const MatrixArguments& arguments) {
  const std::vector<MatrixSource> sources = matrix_sources(arguments);
  return std::none_of(sources.begin(), sources.end(), [](const MatrixSource& s) { return s.recording.make.empty(); });
}

/// The values in force of the parameters.
std::vector<std::string> values_in_force(const SweepArguments& arguments, const std::vector<Parameter>& parameters,
                                         const Settings& settings) {
  Settings all = arguments.matrix.settings;
  all.insert(all.end(), settings.begin(), settings.end());
  const std::vector<OptionInfo> options = describe_odometry(arguments.pipeline, parse_settings(all));
  std::vector<std::string> values;
  for (const Parameter& parameter : parameters) {
    const auto found = std::find_if(options.begin(), options.end(),
                                    [&](const OptionInfo& option) { return option.key == parameter.key; });
    if (found == options.end()) throw Error("--param " + parameter.key, "is no option of " + arguments.pipeline);
    values.push_back(found->value);
  }
  return values;
}

struct Plan {
  std::vector<Method> methods;
  std::vector<std::vector<std::string>> values;  ///< by method
};

Plan plan_of(const SweepArguments& arguments, const std::vector<Parameter>& parameters) {
  Plan plan;
  const bool scored = arguments.pipeline == kFiltered && labelled(arguments.matrix);
  for (const Settings& settings : arguments.grid ? as_grid(parameters) : each_alone(parameters)) {
    plan.values.push_back(values_in_force(arguments, parameters, settings));
    plan.methods.push_back(method_of(arguments, settings));
    if (scored) plan.methods.back().commands.push_back(score_command(arguments, settings));
  }
  return plan;
}

Sweep judged(const SweepArguments& arguments, const std::vector<Parameter>& parameters, const Plan& plan,
             const std::vector<MatrixRun>& runs) {
  Sweep sweep;
  sweep.version = TILTH_VERSION;
  sweep.pipeline = arguments.pipeline;
  sweep.judging = judging_of(arguments.matrix);
  for (const Parameter& parameter : parameters) sweep.parameters.push_back(parameter.key);
  sweep.base = values_in_force(arguments, parameters, {});
  sweep.grid = arguments.grid;
  const std::vector<RunOutcome> outcomes = judge_runs(arguments.matrix, runs);
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const std::size_t method = i % plan.methods.size();  // runs of a recording stand side by side
    const StudyFigures figures = study_figures(runs[i].job.folder);
    sweep.runs.push_back({plan.values[method], outcomes[i], figures});
  }
  return sweep;
}

int sweep_parameters(const SweepArguments& arguments) {
  const std::vector<Parameter> parameters = parameters_of(arguments);
  const Plan plan = plan_of(arguments, parameters);
  const std::vector<MatrixRun> runs = plan_runs(arguments.matrix, plan.methods);
  if (const std::optional<int> exit_code = carry_out(arguments.matrix, runs)) return *exit_code;
  const Sweep sweep = judged(arguments, parameters, plan, runs);
  write_sweep(arguments.matrix.out, sweep);
  std::fputs(table_text(sweep_table(sweep)).c_str(), stdout);
  return 0;
}

}  // namespace

void add_sweep(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("sweep", "Study what the parameters of a pipeline do");
  const auto arguments = std::make_shared<SweepArguments>();
  command->add_option("--pipeline", arguments->pipeline, "see `tilth pipelines` (" + arguments->pipeline + ")");
  command->add_option("--param", arguments->parameters, "key=a,b,c; as often as wanted")
      ->required()
      ->allow_extra_args(false);
  command->add_flag("--grid", arguments->grid, "every combination, instead of each parameter alone");
  command->add_option("--score-every", arguments->score_every, "judge the filter on each n-th scan (50)")
      ->check(CLI::Range(1, 1000000));
  add_matrix_arguments(*command, arguments->matrix);
  command->callback([arguments, &exit_code] { exit_code = sweep_parameters(*arguments); });
}

}  // namespace tilth::app
