// tilth completion: what a shell completes the command line by. tilth manual: pages for man. Both of the command line
// itself.
#include <cstdio>
#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>

#include "commands.hpp"
#include "man_page.hpp"
#include "shell_completion.hpp"
#include <tilth/io/output_file.hpp>
#include <tilth/odometry/make_odometry.hpp>
#include <tilth/simulation/scenes.hpp>

namespace tilth::app {
namespace {

CommandInfo whole_program(const CLI::App& app) {
  CommandInfo program = command_tree(app);
  std::vector<std::string> names;
  for (const PipelineInfo& pipeline : pipelines()) names.push_back(pipeline.name);
  give_choices(program, "pipeline", names);
  give_choices(program, "scene", {scene_names().begin(), scene_names().end()});
  return program;
}

void print_completion(const CLI::App& app, const std::string& shell) {
  const CommandInfo program = whole_program(app);
  const auto script = shell == "bash"  ? bash_completion(program)
                      : shell == "zsh" ? zsh_completion(program)
                                       : fish_completion(program);
  std::fputs(script.c_str(), stdout);
}

void write_manual(const CLI::App& app, const std::filesystem::path& folder) {
  const CommandInfo program = whole_program(app);
  std::filesystem::create_directories(folder);
  for (const CommandInfo* command : all_commands(program))
    write_text(folder / (man_name(*command) + ".1"), man_page(program, *command, TILTH_VERSION));
}

}  // namespace

void add_completion(CLI::App& app, int&) {
  CLI::App* command = app.add_subcommand("completion", "Print a script by which a shell completes the command line");
  const auto shell = std::make_shared<std::string>();
  command->add_option("SHELL", *shell, "to source the script")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish"}))
      ->option_text("bash | zsh | fish");
  command->callback([&app, shell] { print_completion(app, *shell); });
}

void add_manual(CLI::App& app, int&) {
  CLI::App* command = app.add_subcommand("manual", "Write the pages of all commands for man");
  const auto folder = std::make_shared<std::string>();
  command->add_option("DIR", *folder, "folder for the pages; made where missing")->required();
  command->callback([&app, folder] { write_manual(app, *folder); });
}

}  // namespace tilth::app
