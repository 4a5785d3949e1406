// tilth simulate: a scene becomes a recording with exact truth.
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "commands.hpp"
#include "console.hpp"
#include "option_arguments.hpp"
#include "recording_folder.hpp"
#include <tilth/core/parallel.hpp>

namespace tilth::app {
namespace {

constexpr std::size_t kScansAtOnce = 8;

struct SimulateArguments {
  std::string scene, out, format = "pcd";
  std::vector<std::string> settings;
  bool quiet = false;
};

void simulate(const SimulateArguments& arguments) {
  const SimulationOptions options = simulation_options(arguments.scene, parse_settings(arguments.settings));
  const Simulator simulator(arguments.scene, options);
  RecordingFolder folder(arguments.out, scan_format(arguments.format));
  folder.write_recipe(arguments.scene, options);
  folder.write_truth(simulator);
  Console console(arguments.quiet);
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
  command->add_option("scene", arguments->scene, "One of " + scenes)->required();
  command->add_option("--out", arguments->out, "Folder to write to")->required();
  command->add_option("--format", arguments->format, "pcd (default), kitti or bag");
  add_settings(*command, arguments->settings, "Any options listed below");
  add_setting(*command, *arguments, "sensor", "leishen_c16, vlp16, hdl32 or hdl64");
  add_setting(*command, *arguments, "seed", "Of the scene and of the noise");
  add_setting(*command, *arguments, "duration", "[s] at most");
  add_setting(*command, *arguments, "noise", "[m] standard deviation of a range");
  command->add_flag_callback(
      "--snapshot", [arguments] { arguments->settings.push_back("snapshot=true"); },
      "All beams of a scan from one pose, as Gazebo does");
  command->add_flag("--quiet", arguments->quiet, "Say nothing but errors");
  command->footer(listing());
  command->callback([arguments] { simulate(*arguments); });
}

}  // namespace tilth::app
