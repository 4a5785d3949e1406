// Places to drive a LiDAR through, made from parameters and a seed: a mesh, what moves in it, and the sensor's truth.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include <tilth/core/options.hpp>
#include <tilth/core/trajectory.hpp>
#include <tilth/simulation/mesh.hpp>
#include <tilth/simulation/motion.hpp>
#include <tilth/simulation/movers.hpp>

namespace tilth {

struct SceneOptions {
  std::uint64_t seed = 1;
  std::uint64_t world_seed = 0;  ///< of what stands in the scene; 0: `seed`
  double changed = 0.0;          ///< share of what people move that was moved, removed or added since
  double duration = 0.0;         ///< [s] at most; 0: the whole way
  double speed = 1.0;            ///< [-] the same way so many times as fast
  double height = 0.8;           ///< [m] of the sensor above the floor
  int people = 2;
  double bare = 12.0;            ///< [m] of corridor, about its middle, without any feature
  double vibration = 0.0;        ///< [m] deviation of each coordinate
  double vibration_angle = 0.0;  ///< [deg] deviation about each axis
  double kidnap = 0.0;           ///< [s] at which the sensor is carried on along its way; 0: never
  double kidnap_jump = 20.0;     ///< [m] of the way that it is carried
  double covered = 0.0;          ///< [s] from then on for which it sees nothing
};

template <class V>
void visit(SceneOptions& o, V&& v) {
  v("seed", o.seed, Bounds{0, 9e15}, "[-] of the scene and of the noise");
  v("world_seed", o.world_seed, Bounds{0, 9e15},
    "[-] of what stands in the scene, apart from noise, wobble and people; 0: the same as seed");
  v("changed", o.changed, Bounds{0, 1},
    "[-] share of furniture, boards, cars ... that was moved, removed or added, as seed tells; the way stays free");
  v("duration", o.duration, Bounds{0, 3600}, "[s] the recording is cut here; 0: the whole way");
  v("speed", o.speed, Bounds{0.1, 10}, "[-] the same way driven so many times as fast");
  v("height", o.height, Bounds{0.2, 2.5}, "[m] of the sensor above the floor");
  v("people", o.people, Bounds{0, 50}, "[-] people who walk about");
  v("bare", o.bare, Bounds{0, 1000}, "[m] of a corridor, about its middle, without any feature; 1000: a bare tunnel");
  v("vibration", o.vibration, Bounds{0, 0.05}, "[m] standard deviation of the vibration along each axis");
  v("vibration_angle", o.vibration_angle, Bounds{0, 5}, "[deg] standard deviation of the vibration about each axis");
  v("kidnap", o.kidnap, Bounds{0, 3600}, "[s] at which the sensor is carried on along its way at once; 0: never");
  v("kidnap_jump", o.kidnap_jump, Bounds{0, 1e4}, "[m] of the way over which it is carried then");
  v("covered", o.covered, Bounds{0, 3600}, "[s] for which it then stands still and sees nothing");
}

struct Scene {
  Mesh mesh;
  Movers movers;
  Trajectory trajectory;  ///< of the LiDAR in the world, 200 Hz, from time 0
};

/// The seed of what stands in a scene.
inline std::uint64_t world_seed_of(const SceneOptions& options) {
  return options.world_seed > 0 ? options.world_seed : options.seed;
}

Scene corridor(const SceneOptions& options);    ///< of a school: two right turns, doors, notice boards, bare stretches
Scene plaza(const SceneOptions& options);       ///< before a building: paving, steps, trees, flower beds, facades
Scene hospital(const SceneOptions& options);    ///< corridor with wards, beds, metal cabinets, doors that swing
Scene auditorium(const SceneOptions& options);  ///< hall with rising rows of seats and a stage
Scene office(const SceneOptions& options);      ///< round trip past rooms with desks and shelves
Scene street(const SceneOptions& options);      ///< houses, parked cars, trees and poles, at 8 m/s
Scene city(const SceneOptions& options);        ///< a grid of such streets, some driven twice and both ways, at 9 m/s

std::span<const std::string_view> scene_names();

/// The scene of that name; its variants (corridor_fast ...) differ in their options alone. Throws Error listing the
/// names.
Scene make_scene(std::string_view name, const SceneOptions& options);

}  // namespace tilth
