// tilth: one binary, one file a subcommand.
#include <algorithm>
#include <cstdio>
#include <exception>

#include <CLI/CLI.hpp>

#include "commands.hpp"
#include "option_arguments.hpp"

namespace tilth::app {
namespace {

/// In the order in which the help lists them.
void add_commands(CLI::App& app, int& exit_code) {
  add_run(app, exit_code);
  add_pipelines(app, exit_code);
  add_config(app, exit_code);
  add_evaluate(app, exit_code);
  add_evaluate_map(app, exit_code);
  add_info(app, exit_code);
  add_simulate(app, exit_code);
  add_convert(app, exit_code);
  add_live(app, exit_code);
  add_play(app, exit_code);
  add_score_filter(app, exit_code);
  add_score_basin(app, exit_code);
  add_assess(app, exit_code);
  add_score_moving(app, exit_code);
  add_view(app, exit_code);
  add_compare(app, exit_code);
  add_sweep(app, exit_code);
  add_calibrate(app, exit_code);
  add_map(app, exit_code);
  add_localize(app, exit_code);
  add_job(app, exit_code);
  add_sensors(app, exit_code);
  add_completion(app, exit_code);
  add_manual(app, exit_code);
}

}  // namespace
}  // namespace tilth::app

int main(int argc, char** argv) {
  CLI::App app{"Tilth: trajectory and map from the scans of one spinning LiDAR, and nothing else."};
  app.name("tilth");
  app.set_version_flag("--version", TILTH_VERSION);
  app.require_subcommand(1);
  int exit_code = 0;
  tilth::app::add_commands(app, exit_code);
  try {
    std::vector<std::string> arguments = tilth::app::spread_settings({argv + 1, std::size_t(argc - 1)});
    std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants them
    app.parse(std::move(arguments));
  } catch (const CLI::ParseError& e) {
    return app.exit(e);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "tilth: error: %s\n", e.what());
    return 1;
  }
  return exit_code;
}
