// tilth pipelines: what can be named by --pipeline.
#include <cstdio>

#include <CLI/CLI.hpp>

#include "commands.hpp"
#include <tilth/odometry/make_odometry.hpp>

namespace tilth::app {

void add_pipelines(CLI::App& app, int& exit_code) {
  app.add_subcommand("pipelines", "List the pipelines, the default one first")->callback([&exit_code] {
    for (const PipelineInfo& pipeline : pipelines()) {
      std::printf("%-20s %s\n", pipeline.name.c_str(), pipeline.summary.c_str());
    }
    exit_code = 0;
  });
}

}  // namespace tilth::app
