#include <cmath>
#include <numbers>

#include <tilth/simulation/furniture.hpp>
#include <tilth/simulation/layout.hpp>
#include <tilth/simulation/scenes.hpp>

namespace tilth {
namespace {

using Eigen::Vector3d;

constexpr double kQuarter = std::numbers::pi / 2;
constexpr double kLength = 25, kWidth = 18, kHeight = 7;  // [m] of the hall, x from -3, y from -3
constexpr double kWestEdge = -2.5, kSouthEdge = -2.5;     // [m] of its walls; the drive starts at the origin
constexpr double kRowDepth = 0.95, kRowRise = 0.22;       // [m]
constexpr int kRows = 11;
constexpr std::uint64_t kStream = 0x40;

/// Round the rows of seats: along the south aisle, past the stage, back along the north aisle, a look at the doors.
const std::vector<Leg> kLegs{{4, 0, 0},     {28, 0.6, 0},          {3.5, 0.45, kQuarter}, {15, 0.65, 0}, {3, 0, 0},
                             {1.5, 0.4, 0}, {3.5, 0.45, kQuarter}, {24, 0.65, 0},         {3, 0, 0}};

struct Look {
  SurfaceId wall, panel, floor, seat, step, stage, door, metal;
};

Look look_of(Mesh& mesh) {
  return {
      add_surface(mesh, {"wall", Material::matte, 0.6}),   add_surface(mesh, {"acoustic panel", Material::matte, 0.45}),
      add_surface(mesh, {"floor", Material::glossy, 0.3}), add_surface(mesh, {"seat", Material::matte, 0.2}),
      add_surface(mesh, {"riser", Material::matte, 0.35}), add_surface(mesh, {"stage", Material::matte, 0.4}),
      add_surface(mesh, {"door", Material::matte, 0.4}),   add_surface(mesh, {"duct", Material::metal, 0.5})};
}

void add_shell(Mesh& mesh, const Look& look) {
  const auto corner = [](double x, double y) { return Vector3d(kWestEdge + x, kSouthEdge + y, 0); };
  const Opening door{3.0, 1.8, 0, 2.2, 0.12, int(look.door)};
  Opening second = door;
  second.at = 14.0;
  add_wall(mesh, look.wall, {corner(0, 0), corner(kLength, 0), kHeight, {door}});
  add_wall(mesh, look.wall, {corner(kLength, 0), corner(kLength, kWidth), kHeight, {}});
  add_wall(mesh, look.wall, {corner(kLength, kWidth), corner(0, kWidth), kHeight, {door, second}});
  add_wall(mesh, look.wall, {corner(0, kWidth), corner(0, 0), kHeight, {}});
  const Vector3d x = kLength * Vector3d::UnitX(), y = kWidth * Vector3d::UnitY();
  add_quad(mesh, look.floor, corner(0, 0), {x, y}, kAllSides);
  add_quad(mesh, look.wall, corner(0, 0) + Vector3d(0, 0, kHeight), {x, y}, kAllSides);
}

/// Panels on the long walls and air ducts of bare metal under the ceiling.
void add_fittings(Mesh& mesh, const Look& look) {
  for (double x = 6.5; x < kLength - 2; x += 3.4) {
    const double west = kWestEdge + x;
    add_box(mesh, look.panel, upright({west, kSouthEdge + 0.04, 0.5}, 0), {2.0, 0.08, 4.5});
    add_box(mesh, look.panel, upright({west + 3.4, kSouthEdge + kWidth - 0.04, 2.6}, 0), {2.0, 0.08, 2.6});
  }
  for (const double y : {4.5, 13.5}) {
    const Vector3d middle(kWestEdge + kLength / 2, kSouthEdge + y, kHeight - 1.1);
    add_box(mesh, look.metal, upright(middle, 0), {kLength - 3, 0.7, 0.5});
  }
}

/// One row on its step: a riser, and seats with backs, some of them folded up.
void add_row(Mesh& mesh, const Look& look, int row, CounterRandom& random) {
  const double x = kWestEdge + 14.8 - row * kRowDepth, z = row * kRowRise, middle = kSouthEdge + kWidth / 2;
  const double width = kWidth - 8.4;
  if (row > 0) add_box(mesh, look.step, upright({x, middle, 0}, 0), {kRowDepth, width, z});
  for (double y = 0.5; y < width - 0.4; y += 0.58) {
    if (std::abs(y - width / 2) < 0.7) continue;  // the aisle through the middle
    const Vector3d foot(x - 0.1, middle - width / 2 + y, z);
    add_box(mesh, look.seat, upright(foot + Vector3d(-0.2, 0, 0.4), 0), {0.08, 0.5, 0.5});
    const bool folded = random.chance(0.7);
    const Vector3d size = folded ? Vector3d(0.1, 0.46, 0.4) : Vector3d(0.45, 0.46, 0.08);
    add_box(mesh, look.seat, upright(foot + Vector3d(folded ? -0.1 : 0.06, 0, 0.42), 0), size);
    add_box(mesh, look.seat, upright(foot + Vector3d(-0.2, 0.27, 0), 0), {0.3, 0.05, 0.62});
  }
}

void add_stage(Mesh& mesh, const Look& look) {
  const double east = kWestEdge + kLength, middle = kSouthEdge + kWidth / 2;
  add_box(mesh, look.stage, upright({east - 1.6, middle, 0}, 0), {3.2, 12.0, 0.9});
  for (const double y : {-6.5, 6.5})
    add_box(mesh, look.stage, upright({east - 1.5, middle + y, 0}, 0), {0.9, 1.0, 0.45});
  add_box(mesh, look.panel, upright({east - 2.2, middle + 3, 0.9}, 0), {0.5, 0.7, 1.15});
  add_box(mesh, look.wall, upright({east - 0.1, middle, 2.4}, 0), {0.05, 7.0, 3.6});
}

}  // namespace

Scene auditorium(const SceneOptions& options) {
  CounterRandom random(world_seed_of(options), kStream);
  Scene scene;
  const Look look = look_of(scene.mesh);
  add_shell(scene.mesh, look);
  add_fittings(scene.mesh, look);
  for (int row = 0; row < kRows; ++row) add_row(scene.mesh, look, row, random);
  add_stage(scene.mesh, look);
  const Path path = path_of(kLegs);
  CounterRandom people = random_of_people(random, options);
  scene.movers.walkers = walkers_beside(path, options.people, 0.9, people);
  scene.trajectory = travel(kLegs, options);
  return scene;
}

}  // namespace tilth
