#include <cmath>
#include <numbers>

#include <tilth/simulation/layout.hpp>
#include <tilth/simulation/scenes.hpp>
#include <tilth/simulation/streetside.hpp>

namespace tilth {
namespace {

using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180;
constexpr std::uint64_t kStream = 0x60;

/// About 260 m at 8 m/s: a bend to the left, a bend to the right, a crossing taken to the right.
const std::vector<Leg> kLegs{{1, 0, 0},
                             {4, 8, 0},
                             {2.5, 8, 0},
                             {4, 8, 22 * kDegree},
                             {6, 8, 0},
                             {4, 8, -30 * kDegree},
                             {4, 7, 0},
                             {2, 5, 0},
                             {3.5, 4.5, -80 * kDegree},
                             {3, 7, 0},
                             {3, 8, 0},
                             {3, 0, 0}};

/// Whether all of a disc lies further than `clear` [m] from the way: the inner side of a crossing is near two of its
/// sides.
bool free(const Path& path, const Vector3d& place, double clear) {
  return distance_to(path, place) > clear;
}

void add_ground(Mesh& mesh, const Path& path) {
  Eigen::AlignedBox2d area;
  for (const Vector3d& corner : path) area.extend(corner.head<2>());
  const Eigen::Vector2d low = area.min().array() - 80, size = area.sizes().array() + 160;
  const SurfaceId asphalt = add_surface(mesh, {"asphalt", Material::matte, 0.2});
  const SurfaceId pavement = add_surface(mesh, {"pavement", Material::matte, 0.4});
  add_quad(mesh, asphalt, {low.x(), low.y(), 0}, {Vector3d(size.x(), 0, 0), Vector3d(0, size.y(), 0)}, kNoSides);
  for (const double side : {-1.0, 1.0}) {
    for (double arc = 0; arc < length_of(path); arc += 2.0) {
      const Pose T = frame_at(path, arc + 1.0) * upright({0, side * 0.5 * (kKerb + kHouses), 0}, 0);
      if (free(path, T.translation(), kKerb + 1.2)) add_box(mesh, pavement, T, {2.0, kHouses - kKerb, 0.12});
    }
  }
}

}  // namespace

Scene street(const SceneOptions& options) {
  CounterRandom random(world_seed_of(options), kStream);
  SceneOptions plain = options;
  plain.seed = world_seed_of(options), plain.duration = 0, plain.speed = 1;
  const Path path = lengthened(footprint(travel(kLegs, plain)), 40);
  Scene scene;
  const auto is_free = [&](const Vector3d& place, double clear) { return free(path, place, clear); };
  add_ground(scene.mesh, path);
  for (const double side : {-1.0, 1.0}) {
    add_houses(scene.mesh, path, side, is_free, random);
    add_kerbside(scene.mesh, path, side, is_free, random);
  }
  CounterRandom people = random_of_people(random, options);
  scene.movers.walkers = walkers_beside(path, options.people, 7.4, people);
  scene.trajectory = travel(kLegs, options);
  return scene;
}

}  // namespace tilth
