// tilth score-filter: what the outlier filter removes and keeps of scans whose truth is known.
#include <array>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "commands.hpp"
#include "console.hpp"
#include "filter_trial.hpp"
#include "labelled_scans.hpp"
#include "option_arguments.hpp"
#include <tilth/io/output_file.hpp>
#include <tilth/simulation/scenes.hpp>
#include <tilth/study/filter_report.hpp>

namespace tilth::app {
namespace {

constexpr std::array<const char*, 2> kReadings{"inverse", "difference"};
constexpr std::array<const char*, 6> kNeighbors{"5", "8", "10", "15", "20", "30"};
constexpr std::array<const char*, 5> kAlphas{"0.5", "0.8", "1", "1.5", "2"};

struct ScoreFilterArguments {
  std::vector<std::string> recordings, settings;
  OptionValues simulation;
  int every = 50;
  bool sweep = false;
  std::string json, csv;
};

/// Every combination of the paper's formula that its text leaves open or makes claims about; then what was asked for.
std::vector<ImprovedFloamOptions> options_to_try(const ScoreFilterArguments& arguments) {
  const OptionValues given = parse_settings(arguments.settings);
  const auto asked = with<ImprovedFloamOptions>(given);
  std::vector<ImprovedFloamOptions> all;
  if (!arguments.sweep) return {asked};
  for (const char* reading : kReadings) {
    for (const char* k : kNeighbors) {
      for (const char* alpha : kAlphas) {
        OptionValues values{{"outliers.method", "weighted"},
                            {"outliers.density", reading},
                            {"outliers.k", k},
                            {"outliers.alpha", alpha}};
        values.insert(given.begin(), given.end());  // those that are swept stay as they are
        all.push_back(with<ImprovedFloamOptions>(values));
      }
    }
  }
  all.push_back(asked);
  return all;
}

std::vector<FilterTrial> try_all(const ScoreFilterArguments& arguments) {
  const std::vector<ImprovedFloamOptions> options = options_to_try(arguments);
  std::vector<FilterTrial> trials;
  Console console(false);
  for (const std::string& recording : arguments.recordings) {
    const auto scans = labelled_scans({recording, arguments.simulation, std::size_t(arguments.every)});
    for (const ImprovedFloamOptions& o : options) {
      trials.push_back({recording, describe_filter(o), try_filter(scans, o)});
      console.progress(trials.size(), options.size() * arguments.recordings.size());
    }
  }
  console.clear_progress();
  return trials;
}

void print(const ScoreFilterArguments& arguments, const std::vector<FilterTrial>& trials) {
  const std::vector<std::string> columns{"outliers.method", "outliers.density", "outliers.k", "outliers.alpha"};
  std::string text;
  if (arguments.sweep) text = filter_sweep_table(trials, columns);
  if (!arguments.sweep) {
    for (const FilterTrial& trial : trials) text += (text.empty() ? "" : "\n") + filter_table(trial);
  }
  std::fputs(text.c_str(), stdout);
}

void score_filters(const ScoreFilterArguments& arguments) {
  const std::vector<FilterTrial> trials = try_all(arguments);
  if (!arguments.json.empty()) write_text(arguments.json, filter_json(trials));
  if (!arguments.csv.empty()) write_text(arguments.csv, filter_csv(trials));
  print(arguments, trials);
}

std::string footer() {
  std::string text =
      "A folder must have been written by `tilth simulate` (labels/ tells what every point is); a scene is simulated,\n"
      "also where a folder has its name: ./corridor is the folder.\n"
      "Each n-th scan goes through crop, outlier removal and the choice of features by curvature of neighbours. False\n"
      "points are isolated outliers, mixed pixels and ghosts; obvious ones are the first two where no surface point\n"
      "lies within 0.3 m. A pseudo-feature is an edge feature whose point is false.\n\n"
      "  tilth score-filter corridor plaza hospital --seed 101\n"
      "  tilth score-filter corridor --set outliers.method=weighted outliers.k=8 outliers.alpha=1.5\n"
      "  tilth score-filter corridor plaza hospital --seed 101 --sweep --csv sweep.csv   # the table in the documents\n"
      "  tilth simulate hospital --out H && tilth score-filter H --every 10 --json score.json\n\n"
      "Options of --set (those of `tilth run`):\n";
  for (const OptionInfo& row : describe_filter({})) {
    text += "  " + row.key + " = " + row.value + "  [" + row.unit + "] " + row.meaning + "\n";
  }
  return text;
}

void add_simulation_option(CLI::App& command, ScoreFilterArguments& arguments, const std::string& key,
                           const std::string& help) {
  command.add_option_function<std::string>(
      "--" + key, [&arguments, key](const std::string& text) { arguments.simulation[key] = text; }, help);
}

}  // namespace

void add_score_filter(CLI::App& app, int&) {
  CLI::App* command = app.add_subcommand("score-filter", "Judge the outlier filter on scans whose truth is known");
  const auto arguments = std::make_shared<ScoreFilterArguments>();
  std::string scenes;
  for (const std::string_view name : scene_names()) scenes += (scenes.empty() ? "" : ", ") + std::string(name);
  command->add_option("recordings", arguments->recordings, "Folders of `tilth simulate`, or scenes: " + scenes)
      ->required();
  add_simulation_option(*command, *arguments, "seed", "Of the scenes and of their noise");
  add_simulation_option(*command, *arguments, "duration", "[s] of the scenes at most");
  add_simulation_option(*command, *arguments, "sensor",
                        "Of the scenes: leishen_c16, vlp16, hdl32, hdl64, quanergy_m8, os1_64, ruby_128 or rosette");
  command->add_option("--every", arguments->every, "Take each n-th scan (50)")->check(CLI::Range(1, 1000000));
  add_settings(*command, arguments->settings, "Options of the filter and the features, listed below");
  command->add_flag("--sweep", arguments->sweep,
                    "Both readings of the density term, k of 5 to 30, alpha of 0.5 to 2; then the filter as set");
  command->add_option("--json", arguments->json, "File to write every figure to, as JSON");
  command->add_option("--csv", arguments->csv, "File to write every figure to, one line a trial");
  command->footer(footer());
  command->callback([arguments] { score_filters(*arguments); });
}

}  // namespace tilth::app
