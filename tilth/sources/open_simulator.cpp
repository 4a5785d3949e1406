#include <tilth/core/error.hpp>
#include <tilth/io/trajectory_file.hpp>
#include <tilth/simulation/layout.hpp>
#include <tilth/sources/open_simulator.hpp>
#include <tilth/sources/world_scene.hpp>

namespace tilth {
namespace {

/// Whether a name ends in .world or .sdf.
bool is_world_file(const std::string& name) {
  return name.ends_with(".world") || name.ends_with(".sdf");
}

bool has_own_path(const PathOptions& own) {
  if (!own.path.empty() && !own.waypoints.empty()) throw Error("waypoints", "are given beside a path: one of the two");
  return !own.path.empty() || !own.waypoints.empty();
}

/// Along the poses of a file, which its errors name.
Trajectory followed(const std::string& path, const MotionOptions& motion) {
  const Trajectory poses = read_tum(path);
  try {
    return follow(poses, motion);
  } catch (const Error& error) {
    throw Error(path, error.what());
  }
}

Trajectory own_path(const SimulationOptions& options) {
  const MotionOptions motion = motion_of(options.scene);
  const PathOptions& own = options.path;
  return cut(own.path.empty() ? drive_through(parse_waypoints(own.waypoints, options.scene.height), own, motion)
                              : followed(own.path, motion),
             options.scene.duration);
}

}  // namespace

OpenedSimulator open_simulator(const std::string& name, const OptionValues& values) {
  const bool world_file = is_world_file(name);
  if (name.empty())
    throw Error("scene", "is missing: expected a file or one of " + options_detail::joined(scene_names()));
  OpenedSimulator opened{simulation_options(world_file ? kForeignScene : name, values), nullptr, {}};
  const SimulationOptions& options = opened.options;
  const bool own = has_own_path(options.path);
  if (world_file && !own) {
    throw Error(name,
                "has no way for the sensor: give --waypoints \"x,y;x,y\" or --path FILE.tum (a pose a line: stamp "
                "x y z qx qy qz qw)");
  }
  if (world_file && options.scene.people > 0)
    throw Error("people", "are those of the world file: only its actors walk there");
  Scene scene =
      world_file ? world_scene(name, options.path.model_path, opened.warnings) : make_scene(name, options.scene);
  if (own) {
    scene.trajectory = own_path(options);
    scene.movers.walkers = kept_clear(std::move(scene.movers.walkers), scene.trajectory);
  }
  opened.simulator = std::make_unique<Simulator>(std::move(scene), options);
  return opened;
}

}  // namespace tilth
