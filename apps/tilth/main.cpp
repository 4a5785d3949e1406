// tilth: one binary, one file a subcommand.
#include <cstdio>
#include <exception>

#include "commands.hpp"

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
  tilth::app::add_simulate(app, exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "tilth: error: %s\n", e.what());
    return 1;
  }
  return exit_code;
}
