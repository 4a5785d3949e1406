#include <cmath>
#include <numbers>

#include <tilth/simulation/layout.hpp>
#include <tilth/simulation/outdoor.hpp>
#include <tilth/simulation/scenes.hpp>

namespace tilth {
namespace {

using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kKerb = 5.0, kHouses = 9.0;  // [m] left and right of the vehicle's way
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

/// A frame on the way `arc` [m] from its start, x along it.
Pose frame_at(const Path& path, double arc) {
  for (std::size_t i = 1;; ++i) {
    const Vector3d side = path[i] - path[i - 1];
    if (arc <= side.norm() || i + 1 == path.size()) {
      return upright(path[i - 1] + arc * side.normalized(), std::atan2(side.y(), side.x()));
    }
    arc -= side.norm();
  }
}

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

/// Houses of 9 to 16 m, now and then a gap; each stands a little further back or forward than its neighbour.
void add_houses(Mesh& mesh, const Path& path, double side, CounterRandom& random) {
  for (double arc = -10; arc < length_of(path) + 10;) {
    const double width = random.uniform(9, 16), back = random.uniform(0, 1.8), depth = 9;
    const double middle = arc + width / 2;
    const Pose T = frame_at(path, std::max(middle, 0.0)) *
                   upright({std::min(middle, 0.0), side * (kHouses + back), 0}, side > 0 ? std::numbers::pi : 0.0);
    const int floors = 2 + int(random.uniform(0, 3));
    arc += width + (random.chance(0.25) ? random.uniform(3, 7) : 0.0);
    const auto corner = [&](double x, double y) -> Vector3d { return T * Vector3d(x, y, 0); };
    const Vector3d a = corner(width / 2, 0), b = corner(-width / 2, 0);
    if (!free(path, a, kHouses - 1.5) || !free(path, b, kHouses - 1.5) || !free(path, corner(0, -depth), kHouses))
      continue;
    const Vector3d c = corner(-width / 2, -depth), d = corner(width / 2, -depth);
    add_facade(mesh, a, b, floors);
    const SurfaceId gable = add_surface(mesh, {"gable", Material::matte, 0.5});
    for (const auto& [from, to] : {std::pair{b, c}, std::pair{c, d}, std::pair{d, a}}) {
      add_wall(mesh, gable, {from, to, 3.4 * floors, {}});
    }
  }
}

void add_kerbside(Mesh& mesh, const Path& path, double side, CounterRandom& random) {
  for (double arc = 3; arc < length_of(path) - 3; arc += random.uniform(5.2, 9.0)) {
    const Pose T = frame_at(path, arc);
    const auto beside = [&](double y) -> Vector3d { return T * Vector3d(0, side * y, 0); };
    if (random.chance(0.5) && free(path, beside(3.9), 3.6)) {
      add_car(mesh, T * upright({0, side * 3.9, 0}, random.chance(0.5) ? 0 : std::numbers::pi), random);
    }
    const double choice = random.uniform();
    if (!free(path, beside(5.7), 5.2)) continue;
    if (choice < 0.3)
      add_tree(mesh, beside(5.7), random);
    else if (choice < 0.5)
      add_lamp_post(mesh, beside(5.4), 6.0);
  }
}

}  // namespace

Scene street(const SceneOptions& options) {
  CounterRandom random(options.seed, kStream);
  SceneOptions plain = options;
  plain.duration = 0, plain.speed = 1;
  const Path path = lengthened(footprint(travel(kLegs, plain)), 40);
  Scene scene;
  add_ground(scene.mesh, path);
  for (const double side : {-1.0, 1.0}) {
    add_houses(scene.mesh, path, side, random);
    add_kerbside(scene.mesh, path, side, random);
  }
  scene.movers.walkers = walkers_beside(path, options.people, 7.4, random);
  scene.trajectory = travel(kLegs, options);
  return scene;
}

}  // namespace tilth
