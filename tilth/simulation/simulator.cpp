#include <algorithm>
#include <cmath>

#include <tilth/simulation/another_day.hpp>
#include <tilth/simulation/simulator.hpp>

namespace tilth {
namespace {

LidarModel lidar_of(const SimulationOptions& options) {
  LidarModel lidar = make_lidar(options.sensor);
  return options.columns == 0 ? lidar : with_columns(std::move(lidar), std::size_t(options.columns));
}

}  // namespace

SimulationOptions simulation_defaults(std::string_view scene, bool snapshot) {
  const auto names = scene_names();
  const bool known = scene == kForeignScene || std::find(names.begin(), names.end(), scene) != names.end();
  if (!known) make_scene(scene, {});
  SimulationOptions options;
  if (scene == kForeignScene) options.scene.people = 0;
  if (snapshot) options.noise = gazebo_noise();
  if (scene.starts_with("plaza")) options.scene.people = 6;
  if (scene == "hospital" || scene == "office") options.scene.people = 4;
  if (scene == "street") options.sensor = "hdl64", options.scene.height = 1.9, options.scene.people = 5;
  if (scene == "city") options.scene.height = 1.9, options.scene.people = 5;
  if (scene.ends_with("_fast")) options.scene.speed = 2.5;
  if (scene == "corridor_rough") {
    options.noise.noise = 0.03, options.noise.outliers = 0.02;
    options.scene.people = 8, options.scene.vibration = 0.003, options.scene.vibration_angle = 0.2;
  }
  return options;
}

SimulationOptions simulation_options(std::string_view scene, const OptionValues& values) {
  const auto asked = values.find("snapshot");
  SimulationOptions defaults = simulation_defaults(scene, asked != values.end() && asked->second == "true");
  const auto preset = values.find("beams");
  if (preset != values.end()) defaults.flaws = flaws_of(with<BeamFlawOptions>({*preset}).beams);
  return with(values, std::move(defaults));
}

Simulator::Simulator(std::string_view scene, const SimulationOptions& options)
    : Simulator(make_scene(scene, options.scene), options) {}

Simulator::Simulator(Scene scene, const SimulationOptions& options)
    : sensor_(flawed_lidar(lidar_of(options), options.flaws, options.scene.seed)),
      noise_(options.noise),
      options_(options.scene),
      truth_(std::move(scene.trajectory)) {
  if (truth_.empty()) throw Error("scene", "has no way for the sensor");
  world_ = std::make_unique<MeshWorld>(std::move(scene.mesh), std::move(scene.movers));
}

std::size_t Simulator::size() const {
  const double turns = std::floor((truth_.back().stamp - truth_.front().stamp) / lidar().period + 1e-9);
  return turns < 1 ? 0 : std::size_t(turns) - 1;
}

double Simulator::stamp(std::size_t index) const {
  return truth_.front().stamp + double(index + 1) / (1 / lidar().period);  // 2.9, not 2.9000000000000004
}

LabelledScan Simulator::scan(std::size_t index) const {
  LabelledScan labelled = simulate_scan(*world_, sensor_, truth_, noise_, {stamp(index), options_.seed, index});
  if (is_covered(stamp(index), options_)) labelled.scan.cloud = {}, labelled.labels.clear();
  return labelled;
}

}  // namespace tilth
