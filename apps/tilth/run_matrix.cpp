#include "run_matrix.hpp"

#include <algorithm>
#include <fstream>

#include <CLI/CLI.hpp>

#include "interrupt.hpp"
#include "job_queue.hpp"
#include "option_arguments.hpp"
#include "option_flags.hpp"
#include "task_engine.hpp"
#include <tilth/core/error.hpp>
#include <tilth/odometry/make_odometry.hpp>

namespace tilth::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kReportPoints = "200000";  // of the map in each report.html: a comparison has many

void replace_all(std::string& text, const std::string& name, const std::string& value) {
  for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + value.size()))
    text.replace(at, name.size(), value);
}

MatrixRun plan_run(const MatrixSource& source, const Method& method, const fs::path& out) {
  const std::string seed = source.seed.empty() ? "" : "-" + source.seed;
  const fs::path folder = out / "runs" / folder_name(source.label + seed) / folder_name(method.label);
  std::vector<Command> commands = method.commands;
  for (Command& command : commands) {
    for (std::string& word : command) {
      replace_all(word, "{scans}", source.recording.folder.string());
      replace_all(word, "{query}", source.query);
      replace_all(word, "{out}", folder.string());
    }
  }
  return {{source.label, source.seed, method.label},
          {folder, source.recording, commands, method.program},
          source.truth,
          source.recording.folder / "times.txt"};
}

/// The lines of times.txt, where there is one: so many scans there are.
std::size_t scans_in(const fs::path& times, std::size_t max_scans) {
  std::ifstream in(times);
  std::size_t count = 0;
  for (std::string line; std::getline(in, line);) count += line.empty() ? 0 : 1;
  return max_scans == 0 ? count : std::min(count, max_scans);
}

std::vector<Job> jobs_of(const std::vector<MatrixRun>& runs) {
  std::vector<Job> jobs;
  for (const MatrixRun& run : runs) jobs.push_back(run.job);
  return jobs;
}

/// Does what is not done yet on the engine asked for. Returns false where it was interrupted.
bool perform_runs(const MatrixArguments& arguments, const std::vector<MatrixRun>& runs, Console& console) {
  const std::vector<Job> jobs = jobs_of(runs);
  if (arguments.engine == "dask") {
    perform_on_dask(jobs, {arguments.python, arguments.scheduler, fs::path(arguments.out) / "jobs.json"});
    if (!arguments.keep_recordings) remove_finished_recordings(jobs);
  } else {
    perform_all(jobs, {arguments.at_once, arguments.keep_recordings}, console);
  }
  return interrupted() == 0;
}

/// The lines of --list-jobs.
std::string job_lines(const std::vector<MatrixRun>& runs) {
  std::string text;
  for (const MatrixRun& run : runs) {
    if (!end_of(run.job).done) text += job_line(run.job) + "\n";
  }
  return text;
}

}  // namespace

void add_matrix_arguments(CLI::App& command, MatrixArguments& a) {
  command.add_option("--sources", a.source_lists, "recordings with truth, and sim://SCENE?key=value; a,b")
      ->allow_extra_args(false);
  command.add_option("--source", a.single_sources, "one source, commas and all")->allow_extra_args(false);
  command.add_option("--seeds", a.seeds, "of the simulated sources: 1-5,8 (" + a.seeds + ")");
  command.add_option("--truth", a.truth, "name of the true trajectory beside the recordings, or its path");
  command.add_option("--out", a.out, "folder for the runs and the tables")->required();
  add_settings(command, a.settings, "options of every pipeline");
  command.add_option("--max-scans", a.max_scans, "of each run");
  command.add_option("--jobs", a.at_once, "runs at once; 0: as many as there are processors")
      ->check(CLI::Range(0, 1024));
  command.add_option("--threads", a.threads, "of each run (1: so that its CPU time means something)")
      ->check(CLI::Range(1, 1024));
  command.add_option("--max-ape", a.max_ape, "[m] APE RMSE from which on a run counts as failed")
      ->check(CLI::PositiveNumber);
  add_option_flags(command, describe(judging_defaults().evaluation), a.evaluation);
  command.add_flag("--keep-recordings", a.keep_recordings, "keep the scans of simulated sources");
  command.add_flag("--list-jobs", a.list_jobs, "print a command for each run that is not done, and do nothing");
  command.add_option("--engine", a.engine, "local or dask (" + a.engine + ")")->check(CLI::IsMember({"local", "dask"}));
  command.add_option("--scheduler", a.scheduler, "address of the Dask scheduler, such as tcp://host:8786");
  command.add_option("--python", a.python, "interpreter that has the packages of Dask and of the peers");
  command.add_flag("--quiet", a.quiet, "no progress, only the tables");
}

Method pipeline_method(const std::string& text, const MatrixArguments& arguments) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(':', begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  const std::string name = parts.front();
  const bool file = name.ends_with(".yaml") || name.ends_with(".yml");
  OptionArguments options{file ? "" : name, file ? name : "", arguments.settings};
  options.settings.insert(options.settings.end(), parts.begin() + 1, parts.end());
  const PipelineChoice choice = choose_pipeline(options);
  describe_odometry(choice.name, choice.values);  // throws where a name or value is wrong
  Command run{"tilth", "run", "{scans}{query}", "--out", "{out}", "--pipeline", choice.name, "--quiet"};
  run.insert(run.end(), {"--threads", std::to_string(arguments.threads), "--report-points", kReportPoints});
  if (arguments.max_scans > 0) run.insert(run.end(), {"--max-scans", std::to_string(arguments.max_scans)});
  for (const auto& [key, value] : choice.values) run.insert(run.end(), {"--set", key + "=" + value});
  const std::string& program = own_name();
  return {text, {run}, program};
}

std::vector<MatrixRun> plan_runs(const MatrixArguments& arguments, const std::vector<Method>& methods) {
  const fs::path out = fs::absolute(arguments.out).lexically_normal();
  std::vector<MatrixRun> runs;
  for (const MatrixSource& source : matrix_sources(arguments)) {
    for (const Method& method : methods) {
      runs.push_back(plan_run(source, method, out));
      write_job(runs.back().job);
    }
  }
  return runs;
}

std::optional<int> carry_out(const MatrixArguments& arguments, const std::vector<MatrixRun>& runs) {
  if (arguments.list_jobs) {
    std::fputs(job_lines(runs).c_str(), stdout);
    return 0;
  }
  Console console(arguments.quiet);
  if (perform_runs(arguments, runs, console)) return std::nullopt;
  console.error("interrupted; the same command goes on where it was");
  return kInterruptedExit;
}

JudgingOptions judging_of(const MatrixArguments& arguments) {
  JudgingOptions options = judging_defaults();
  options.evaluation = with<EvaluationOptions>(arguments.evaluation, options.evaluation);
  options.max_ape = arguments.max_ape;
  return options;
}

std::vector<RunOutcome> judge_runs(const MatrixArguments& arguments, const std::vector<MatrixRun>& runs) {
  const JudgingOptions options = judging_of(arguments);
  std::vector<RunOutcome> outcomes;
  for (const MatrixRun& run : runs) {
    const RunPlace place{run.job.folder, run.truth, scans_in(run.times, arguments.max_scans)};
    outcomes.push_back(judge_run(place, run.label, options, end_of(run.job).failure));
  }
  return outcomes;
}

}  // namespace tilth::app
