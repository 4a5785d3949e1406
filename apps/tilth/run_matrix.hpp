// Methods x sources x seeds, each a job of its own: what compare and sweep are made of.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "console.hpp"
#include "job.hpp"
#include <tilth/core/options.hpp>
#include <tilth/study/run_outcome.hpp>

namespace CLI {
class App;
}

namespace tilth::app {

struct MatrixArguments {
  std::vector<std::string> source_lists;  ///< "a,b"
  std::vector<std::string> single_sources;
  std::string seeds = "1";
  std::string out, truth, engine = "local", scheduler, python = "python3";
  std::vector<std::string> settings;  ///< "key=value" for every pipeline
  OptionValues evaluation;
  double max_ape = judging_defaults().max_ape;  ///< [m]
  std::size_t max_scans = 0;                    ///< zero: all
  int at_once = 0, threads = 1;
  bool keep_recordings = false, list_jobs = false, quiet = false;
};

/// Adds what compare and sweep share. `arguments` must outlive the command.
void add_matrix_arguments(CLI::App& command, MatrixArguments& arguments);

/// A recording with truth.
struct MatrixSource {
  std::string label, seed;  ///< seed: empty where there is none
  Recording recording;
  std::filesystem::path truth;
  std::string query = {};  ///< ?key=value, options of the source for `tilth run`; empty: none
};

/// Every source with every seed; those that are no simulation, once. Throws Error naming the argument that is wrong and
/// the recording whose truth is not found.
std::vector<MatrixSource> matrix_sources(const MatrixArguments& arguments);

/// `label` as the name of a folder: plain characters only, unlike any other label's.
std::string folder_name(const std::string& label);

/// Something that makes a trajectory of scans.
struct Method {
  std::string label;
  std::vector<Command> commands;  ///< {scans} stands for the recording, {query} for its options, {out} for the results
  std::string program;            ///< version and fingerprint
};

/// A pipeline with settings: NAME[:key=value]..., NAME a pipeline or a YAML file. Throws Error where one is not known.
Method pipeline_method(const std::string& text, const MatrixArguments& arguments);

struct MatrixRun {
  RunLabel label;
  Job job;
  std::filesystem::path truth, times;
};

/// All runs, those of one recording side by side; job.json is written for each.
std::vector<MatrixRun> plan_runs(const MatrixArguments& arguments, const std::vector<Method>& methods);

/// Does what is not done yet on the engine asked for, or prints its commands by --list-jobs. The exit code where that
/// is all: there is nothing to be judged, or it was interrupted.
std::optional<int> carry_out(const MatrixArguments& arguments, const std::vector<MatrixRun>& runs);

/// How the runs are judged. Throws Error naming the option that is wrong.
JudgingOptions judging_of(const MatrixArguments& arguments);

std::vector<RunOutcome> judge_runs(const MatrixArguments& arguments, const std::vector<MatrixRun>& runs);

}  // namespace tilth::app
