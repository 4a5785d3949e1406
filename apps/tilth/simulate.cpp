// tilth simulate: a scene becomes a recording with exact truth.
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "commands.hpp"
#include "console.hpp"
#include "option_arguments.hpp"
#include "recording_folder.hpp"
#include <tilth/core/parallel.hpp>
#include <tilth/sources/open_simulator.hpp>

namespace tilth::app {
namespace {

constexpr std::size_t kScansAtOnce = 8;

struct SimulateArguments {
  std::string scene, out, format = "pcd";
  std::vector<std::string> settings, model_folders;
  bool quiet = false;
};

/// What --set says, and the folders of --model-path in front of its model_path.
OptionValues values_of(const SimulateArguments& arguments) {
  OptionValues values = parse_settings(arguments.settings);
  std::string folders;
  for (const std::string& folder : arguments.model_folders) folders += folder + ":";
  if (!folders.empty()) values["model_path"] = folders + values["model_path"];
  return values;
}

void simulate(const SimulateArguments& arguments) {
  const OpenedSimulator opened = open_simulator(arguments.scene, values_of(arguments));
  const Simulator& simulator = *opened.simulator;
  Console console(arguments.quiet);
  for (const std::string& warning : opened.warnings) console.warn(warning);
  RecordingFolder folder(arguments.out, scan_format(arguments.format), simulator.lidar());
  folder.write_recipe(arguments.scene, opened.options);
  folder.write_truth(simulator);
  for (std::size_t first = 0; first < simulator.size(); first += kScansAtOnce) {
    std::vector<LabelledScan> scans(std::min(kScansAtOnce, simulator.size() - first));
    parallel_for(scans.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) scans[i] = simulator.scan(first + i);
    });
    for (std::size_t i = 0; i < scans.size(); ++i) folder.write(first + i, scans[i]);
    console.progress(first + scans.size(), simulator.size());
  }
  folder.close();
  console.clear_progress();
  console.note(std::to_string(simulator.size()) + " scans of " + arguments.scene + " in " + arguments.out);
}

/// Every option of --set with the default of a plain scene, for the help.
std::string listing() {
  std::string text = "Options of --set (a scene may have its own defaults: recipe.txt tells what was used):\n";
  for (const OptionInfo& row : describe(SimulationOptions{})) {
    text += "  " + row.key + " = " + row.value + "  [" + row.unit + "] " + row.meaning + "\n";
  }
  return text;
}

/// An option of its own for a key that --set takes as well.
void add_setting(CLI::App& command, SimulateArguments& arguments, const std::string& key, const std::string& help) {
  command.add_option_function<std::string>(
      "--" + key, [&arguments, key](const std::string& text) { arguments.settings.push_back(key + "=" + text); }, help);
}

}  // namespace

void add_simulate(CLI::App& app, int&) {
  CLI::App* command = app.add_subcommand("simulate", "Make a recording with exact truth from a scene");
  const auto arguments = std::make_shared<SimulateArguments>();
  std::string scenes;
  for (const std::string_view name : scene_names()) scenes += (scenes.empty() ? "" : ", ") + std::string(name);
  command->add_option("scene", arguments->scene, "One of " + scenes + "; or a Gazebo world: FILE.world, FILE.sdf")
      ->required();
  command->add_option("--out", arguments->out, "Folder to write to")->required();
  command->add_option("--format", arguments->format,
                      "pcd (default), kitti, bag or pcap (the packets of the sensor, where `tilth sensors` lists it)");
  add_settings(*command, arguments->settings, "Any options listed below");
  std::string lidars;
  for (const std::string_view name : lidar_names()) lidars += (lidars.empty() ? "" : ", ") + std::string(name);
  add_setting(*command, *arguments, "sensor", lidars);
  add_setting(*command, *arguments, "seed", "Of the scene and of the noise");
  add_setting(*command, *arguments, "duration", "[s] at most");
  add_setting(*command, *arguments, "noise", "[m] standard deviation of a range");
  add_setting(*command, *arguments, "beams",
              "Constant errors of the beams: ideal, good or worn; beam_range and others below override single ones");
  add_setting(*command, *arguments, "path", "TUM file of the sensor's poses, instead of the scene's own way");
  add_setting(*command, *arguments, "waypoints",
              "\"x,y[,z];x,y[,z]\" [m] to drive through, instead of the scene's own way");
  add_setting(*command, *arguments, "cruise", "[m/s] through way-points");
  command
      ->add_option("--model-path", arguments->model_folders,
                   "Folder of models that a world file names; may be repeated")
      ->allow_extra_args(false)
      ->option_text("DIR");
  command->add_flag_callback(
      "--snapshot", [arguments] { arguments->settings.push_back("snapshot=true"); },
      "All beams of a scan from one pose, as Gazebo does");
  command->add_flag("--quiet", arguments->quiet, "Say nothing but errors");
  command->footer(listing());
  command->callback([arguments] { simulate(*arguments); });
}

}  // namespace tilth::app
