#include <cmath>
#include <numbers>

#include <tilth/simulation/corridor_shell.hpp>
#include <tilth/simulation/scenes.hpp>

namespace tilth {
namespace {

constexpr double kRight = -std::numbers::pi / 2;
constexpr std::uint64_t kStream = 0x10;

/// Rest for 10 s, right turns at 50 s and 80 s, the peak of 1 m/s between them, a stop at 100 s.
const std::vector<Leg> kLegs{{10, 0, 0},          {14, 0.45, 0}, {13, 0.55, 0},  {11.25, 0.42, 0},
                             {3.5, 0.42, kRight}, {6, 0.55, 0},  {11, 1.0, 0},   {9.5, 0.5, 0},
                             {3.5, 0.42, kRight}, {12, 0.45, 0}, {3.25, 0.4, 0}, {3, 0, 0}};

}  // namespace

Scene corridor(const SceneOptions& options) {
  CounterRandom random(world_seed_of(options), kStream);
  const Path path = path_of(kLegs), whole = lengthened(path, 4.0);
  const double middle = 0.5 * length_of(whole);
  CorridorStyle style;
  style.bare = [&](double arc) { return std::abs(arc - middle) < 0.5 * options.bare; };
  Scene scene;
  add_corridor(scene.mesh, whole, style, random);
  CounterRandom people = random_of_people(random, options);
  scene.movers.walkers = walkers_beside(lengthened(path, 3.3), options.people, 0.75, people);
  scene.trajectory = travel(kLegs, options);
  return scene;
}

}  // namespace tilth
