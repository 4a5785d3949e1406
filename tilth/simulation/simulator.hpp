// A whole recording: scene, sensor and imperfections by name, scan after scan, with truth and labels.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include <tilth/core/options.hpp>
#include <tilth/simulation/beam_flaws.hpp>
#include <tilth/simulation/mesh_world.hpp>
#include <tilth/simulation/path.hpp>
#include <tilth/simulation/scenes.hpp>
#include <tilth/simulation/simulate_scan.hpp>

namespace tilth {

struct SimulationOptions {
  std::string sensor = "vlp16";
  int columns = 0;  ///< firings a turn; 0: as the sensor does
  SceneOptions scene;
  PathOptions path;
  NoiseOptions noise;
  BeamFlawOptions flaws;
};

/// All keys in one flat list, as the command line and sim:// take them.
template <class V>
void visit(SimulationOptions& o, V&& v) {
  v("sensor", o.sensor, "[-] leishen_c16, vlp16, hdl32, hdl64, quanergy_m8, os1_64, ruby_128 or rosette");
  v("columns", o.columns, Bounds{0, 20000}, "[-] firings a turn, evenly spread; 0: as the sensor does");
  visit(o.scene, v);
  visit(o.path, v);
  visit(o.noise, v);
  visit(o.flaws, v);
}

/// A scene that is not one of ours by name: a world file.
inline constexpr std::string_view kForeignScene = "";

/// What a scene differs in from the plain defaults: corridor_rough its noise, street and city their sensor, the fast
/// ones their speed, a foreign one its lack of people. With `snapshot` the noise is that of Gazebo's sensors. Throws
/// Error on an unknown scene.
SimulationOptions simulation_defaults(std::string_view scene, bool snapshot);

/// The options of `scene` with `values` set, those of the preset `beams` beneath them. Throws Error naming the key that
/// is unknown, is no number or breaks its bounds.
SimulationOptions simulation_options(std::string_view scene, const OptionValues& values);

class Simulator {
 public:
  /// Throws Error on an unknown scene or sensor, and on a rosette with flaws.
  Simulator(std::string_view scene, const SimulationOptions& options);
  /// Throws Error on an unknown sensor, a rosette with flaws, a scene without a triangle or with no pose of the sensor.
  Simulator(Scene scene, const SimulationOptions& options);

  std::size_t size() const;               ///< scans in all
  double stamp(std::size_t index) const;  ///< [s] of a scan's first firing; one turn at index 0, as 0 is no time in ROS
  LabelledScan scan(std::size_t index) const;         ///< the same for the same options, in any order
  const Trajectory& truth() const { return truth_; }  ///< T_world_lidar at 200 Hz over all scans
  const LidarModel& lidar() const { return sensor_.lidar; }
  const BeamModel& beams() const { return sensor_.beams; }  ///< true errors of its beams
  const MeshWorld& world() const { return *world_; }

 private:
  FlawedLidar sensor_;
  NoiseOptions noise_;
  SceneOptions options_;
  Trajectory truth_;
  std::unique_ptr<MeshWorld> world_;
};

}  // namespace tilth
