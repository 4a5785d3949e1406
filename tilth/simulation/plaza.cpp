#include <cmath>
#include <numbers>

#include <tilth/simulation/layout.hpp>
#include <tilth/simulation/outdoor.hpp>
#include <tilth/simulation/scenes.hpp>

namespace tilth {
namespace {

using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kMargin = 9.0;  // [m] of plaza about the way
constexpr double kClear = 1.2;   // [m] kept free beside the way
constexpr std::uint64_t kStream = 0x20;

/// 0.5 to 0.8 m/s with stops, a stretch in reverse, turns on the spot and sharp turns under way.
const std::vector<Leg> kLegs{{3, 0, 0},
                             {8, 0.6, 0},
                             {3, 0.6, -60 * kDegree},
                             {8, 0.8, 0},
                             {4, 0, 0},
                             {3, 0, 95 * kDegree},
                             {7, 0.7, 0},
                             {3, 0, 0},
                             {6, -0.5, 0},
                             {2, 0, 0},
                             {3, 0, 110 * kDegree},
                             {9, 0.8, 0},
                             {2.5, 0.6, 70 * kDegree},
                             {8, 0.7, 0},
                             {2.5, 0.6, 80 * kDegree},
                             {10, 0.8, 0},
                             {3, 0.5, -65 * kDegree},
                             {6, 0.6, 0},
                             {3, 0, 0}};

Eigen::AlignedBox2d area_of(const Path& path) {
  Eigen::AlignedBox2d area;
  for (const Vector3d& corner : path) area.extend(corner.head<2>());
  return {area.min().array() - kMargin, area.max().array() + kMargin};
}

/// Places with `room` [m] about them, clear of the way and of each other.
class Ground {
 public:
  Ground(const Eigen::AlignedBox2d& area, const Path& path, CounterRandom& random)
      : area_(area), path_(path), random_(random) {}

  Vector3d take(double room) {
    for (int attempt = 0; attempt < 500; ++attempt) {
      const Vector3d place(random_.uniform(area_.min().x() + room + 1, area_.max().x() - room - 1),
                           random_.uniform(area_.min().y() + room + 1, area_.max().y() - room - 1), 0);
      if (!free(place, room)) continue;
      taken_.push_back({place.x(), place.y(), room});
      return place;
    }
    return {area_.max().x() + 3 + room, area_.min().y() - room, 0};  // the plaza is full: beside it
  }

 private:
  bool free(const Vector3d& place, double room) const {
    if (distance_to(path_, place) < room + kClear) return false;
    for (const Vector3d& other : taken_) {
      if ((other - place).head<2>().norm() < other.z() + room) return false;
    }
    return true;
  }

  Eigen::AlignedBox2d area_;
  const Path& path_;
  CounterRandom& random_;
  std::vector<Vector3d> taken_;  // x, y and the room taken
};

/// The building with its entrance on the north, a wing on the east, houses across the street on the south.
void add_buildings(Mesh& mesh, const Eigen::AlignedBox2d& area) {
  const Vector3d low(area.min().x(), area.min().y(), 0), high(area.max().x(), area.max().y(), 0);
  const Vector3d north_east = high, north_west(low.x(), high.y(), 0), south_east(high.x(), low.y(), 0);
  add_facade(mesh, north_east, north_west, 4);
  add_facade(mesh, south_east + Vector3d(0, 8, 0), north_east, 3);
  add_facade(mesh, low + Vector3d(-6, -14, 0), south_east + Vector3d(4, -14, 0), 3);
  const double middle = 0.5 * (low.x() + high.x());
  add_steps(mesh, upright({middle, high.y() - 2.6, 0}, std::numbers::pi / 2), 6.0, 4);
  const SurfaceId pillar = add_surface(mesh, {"pillar", Material::matte, 0.6});
  for (const double x : {-2.6, 2.6}) add_cylinder(mesh, pillar, upright({middle + x, high.y() - 1.0, 0}, 0), 0.2, 3.4);
  const SurfaceId roof = add_surface(mesh, {"porch", Material::matte, 0.6});
  add_box(mesh, roof, upright({middle, high.y() - 1.0, 3.4}, 0), {6.4, 2.0, 0.25});
}

void add_things(Mesh& mesh, Ground& ground, CounterRandom& random) {
  for (int i = 0; i < 4; ++i) {
    const double radius = random.uniform(1.0, 1.9);
    add_flower_bed(mesh, ground.take(radius + 0.2), radius, random);
  }
  for (int i = 0; i < 9; ++i) add_tree(mesh, ground.take(0.5), random);
  for (int i = 0; i < 6; ++i) add_lamp_post(mesh, ground.take(0.3), 4.2);
  for (int i = 0; i < 5; ++i) add_bench(mesh, upright(ground.take(1.1), random.uniform(0, 2 * std::numbers::pi)));
}

}  // namespace

Scene plaza(const SceneOptions& options) {
  CounterRandom random(world_seed_of(options), kStream);
  SceneOptions whole = options;
  whole.seed = world_seed_of(options), whole.duration = 0, whole.speed = 1;
  const Path path = footprint(travel(kLegs, whole));
  const Eigen::AlignedBox2d area = area_of(path);
  Scene scene;
  add_paving(scene.mesh, area, 1.2, random);
  const SurfaceId asphalt = add_surface(scene.mesh, {"asphalt", Material::matte, 0.2});
  add_quad(scene.mesh, asphalt, {area.min().x() - 40, area.min().y() - 40, -0.04},
           {Vector3d(area.sizes().x() + 80, 0, 0), Vector3d(0, area.sizes().y() + 80, 0)}, kNoSides);
  add_buildings(scene.mesh, area);
  Ground ground(area, path, random);
  add_things(scene.mesh, ground, random);
  for (int i = 0; i < options.people; ++i) {
    Walker walker{{ground.take(0.4), ground.take(0.4)}};
    walker.speed = random.uniform(0.7, 1.4), walker.start = random.uniform(0, 20);
    scene.movers.walkers.push_back(std::move(walker));
  }
  scene.trajectory = travel(kLegs, options);
  return scene;
}

}  // namespace tilth
