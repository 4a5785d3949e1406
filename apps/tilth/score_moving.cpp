// tilth score-moving: what is taken out of the map as moving, of scenes whose truth is known.
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "commands.hpp"
#include "console.hpp"
#include <tilth/odometry/make_odometry.hpp>
#include <tilth/run/map_builder.hpp>
#include <tilth/run/stopwatch.hpp>
#include <tilth/simulation/simulator.hpp>

namespace tilth::app {
namespace {

struct ScoreMovingArguments {
  std::vector<std::string> scenes;
  OptionValues simulation;
  std::string pipeline;
};

/// Points of one kind, in the map and taken out of it.
struct KindCount {
  std::size_t in_map = 0, taken_out = 0;

  void print(const char* name) const {
    const std::size_t all = in_map + taken_out;
    std::printf("  %-22s %9zu  %9zu  %6.2f %%\n", name, all, taken_out,
                all == 0 ? 0.0 : 100.0 * double(taken_out) / double(all));
  }
};

struct MovingScore {
  KindCount moving, surfaces, edges, others;  ///< edges: surfaces within 5 cm of one; poles and trunks as a whole
  double milliseconds = 0.0;                  ///< [ms] CPU time a scan of building the map

  KindCount& of(std::uint8_t label) {
    if (kind_of(label) == PointKind::moving) return moving;
    if (kind_of(label) != PointKind::surface) return others;
    return is_on_edge(label) ? edges : surfaces;
  }
};

/// Scans go through the pipeline with their labels as intensities, which the map hands on and no pipeline reads.
MovingScore score_scene(const std::string& scene, const ScoreMovingArguments& arguments, Console& console) {
  const Simulator simulator(scene, simulation_options(scene, arguments.simulation));
  const std::unique_ptr<Odometry> odometry = make_odometry(arguments.pipeline, {});
  MapBuilder map{MapOptions{}};
  double milliseconds = 0.0;
  for (std::size_t i = 0; i < simulator.size(); ++i) {
    LabelledScan made = simulator.scan(i);
    made.scan.cloud.intensities.assign(made.labels.begin(), made.labels.end());
    const OdometryResult result = odometry->register_scan(made.scan);
    const double before = thread_cpu_milliseconds();
    map.add(result, made.scan.stamp);
    milliseconds += thread_cpu_milliseconds() - before;
    console.progress(i + 1, simulator.size());
  }
  const double before = thread_cpu_milliseconds();
  map.settle();
  milliseconds += thread_cpu_milliseconds() - before;
  console.clear_progress();
  MovingScore score;
  score.milliseconds = milliseconds / double(simulator.size());
  for (const MapPoint& p : map.points()) ++score.of(std::uint8_t(p.intensity)).in_map;
  for (const MapPoint& p : map.moving()) ++score.of(std::uint8_t(p.intensity)).taken_out;
  return score;
}

void score_moving(const ScoreMovingArguments& arguments) {
  Console console(false);
  for (const std::string& scene : arguments.scenes) {
    const MovingScore score = score_scene(scene, arguments, console);
    std::printf("%s\n  %-22s %9s  %9s\n", scene.c_str(), "points of the map", "in all", "taken out");
    score.moving.print("moving");
    score.surfaces.print("surfaces");
    score.edges.print("edges and poles");
    score.others.print("stray, mixed, mirrored");
    std::printf("  %.2f ms of CPU a scan for the map\n", score.milliseconds);
  }
}

}  // namespace

void add_score_moving(CLI::App& app, int&) {
  CLI::App* command =
      app.add_subcommand("score-moving", "Judge what is taken out of the map as moving, where the truth is known");
  const auto arguments = std::make_shared<ScoreMovingArguments>();
  command->add_option("scenes", arguments->scenes, "Scenes of `tilth simulate`")->required();
  for (const char* key : {"seed", "duration", "people", "sensor", "speed", "beams"}) {
    command->add_option_function<std::string>(
        std::string("--") + key, [arguments, key](const std::string& text) { arguments->simulation[key] = text; },
        "As `tilth simulate --set` takes it");
  }
  arguments->pipeline = pipelines().front().name;
  command->add_option("--pipeline", arguments->pipeline, "See `tilth pipelines`; default: the first of them");
  command->callback([arguments] { score_moving(*arguments); });
}

}  // namespace tilth::app
