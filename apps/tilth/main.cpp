// tilth: one binary, one file a subcommand.
#include <algorithm>
#include <cstdio>
#include <exception>

#include <CLI/CLI.hpp>

#include "commands.hpp"
#include "option_arguments.hpp"

int main(int argc, char** argv) {
  CLI::App app{"Tilth: trajectory and map from the scans of one spinning LiDAR, and nothing else."};
  app.name("tilth");
  app.set_version_flag("--version", TILTH_VERSION);
  app.require_subcommand(1);
  int exit_code = 0;
  tilth::app::add_run(app, exit_code);
  tilth::app::add_pipelines(app, exit_code);
  tilth::app::add_config(app, exit_code);
  tilth::app::add_evaluate(app, exit_code);
  tilth::app::add_evaluate_map(app, exit_code);
  tilth::app::add_info(app, exit_code);
  tilth::app::add_simulate(app, exit_code);
  tilth::app::add_convert(app, exit_code);
  tilth::app::add_live(app, exit_code);
  tilth::app::add_play(app, exit_code);
  tilth::app::add_score_filter(app, exit_code);
  tilth::app::add_score_basin(app, exit_code);
  tilth::app::add_assess(app, exit_code);
  tilth::app::add_score_moving(app, exit_code);
  tilth::app::add_view(app, exit_code);
  tilth::app::add_compare(app, exit_code);
  tilth::app::add_sweep(app, exit_code);
  tilth::app::add_calibrate(app, exit_code);
  tilth::app::add_map(app, exit_code);
  tilth::app::add_localize(app, exit_code);
  tilth::app::add_job(app, exit_code);
  tilth::app::add_sensors(app, exit_code);
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
