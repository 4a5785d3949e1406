#include <cmath>
#include <numbers>

#include <tilth/simulation/corridor_shell.hpp>
#include <tilth/simulation/rooms_beside.hpp>
#include <tilth/simulation/scenes.hpp>

namespace tilth {
namespace {

constexpr double kLeft = std::numbers::pi / 2;
constexpr double kHalfWidth = 1.1, kHeight = 2.7;  // [m]
constexpr std::uint64_t kStream = 0x50;

/// Once round the block and a little past the start.
const std::vector<Leg> kLegs{{4, 0, 0},         {34, 0.7, 0}, {3.5, 0.5, kLeft}, {18, 0.75, 0},
                             {3.5, 0.5, kLeft}, {34, 0.7, 0}, {3.5, 0.5, kLeft}, {18, 0.75, 0},
                             {3.5, 0.5, kLeft}, {7, 0.6, 0},  {3, 0, 0}};

void furnish_office(Mesh& mesh, Movers& movers, const RoomsBeside::Taken& taken, CounterRandom& random) {
  const Room& room = taken.room;
  add_room(mesh, room, taken.door_width);
  const double far = room.wall + room.depth, side = room.width / 2;
  const Pose& T = room.T_world_entry;
  add_desk(mesh, T * upright({far - 1.1, side - 0.05, 0}, std::numbers::pi));
  add_desk(mesh, T * upright({far - 1.1, -side + 0.05, 0}, 0));
  add_shelf(mesh, T * upright({far, random.uniform(-0.6, 0.6), 0}, kLeft));
  add_shelf(mesh, T * upright({room.wall + 0.7, side, 0}, std::numbers::pi));
  if (!random.chance(0.3)) return;
  Door door;
  door.hinge = T * Eigen::Vector3d(room.wall - 0.02, -taken.door_width / 2, 0);
  door.closed_yaw = std::atan2(T.linear()(1, 1), T.linear()(0, 1));
  door.swing = -random.uniform(1.2, 1.5), door.width = taken.door_width;
  door.period = random.uniform(16, 40), door.phase = random.uniform(0, 40);
  movers.doors.push_back(door);
}

}  // namespace

Scene office(const SceneOptions& options) {
  CounterRandom random(world_seed_of(options), kStream);
  const Path path = path_of(kLegs);
  const Path ring{path[1], path[2], path[3], path[4], path[1]};
  CorridorStyle style;
  style.half_width = kHalfWidth, style.height = kHeight, style.least_gap = 1.2, style.most_gap = 3.5;
  style.adorned = 0.3, style.floor = Material::matte;
  RoomsBeside rooms(ring, kHalfWidth);
  style.opens = [&](const Pose& T_world_entry, double width) {
    return random.chance(0.6) && rooms.take({T_world_entry, 3.9, 4.3, kHeight}, width);
  };
  Scene scene;
  add_corridor(scene.mesh, ring, style, random);
  for (const RoomsBeside::Taken& room : rooms.taken()) furnish_office(scene.mesh, scene.movers, room, random);
  CounterRandom people = random_of_people(random, options);
  scene.movers.walkers = walkers_beside(ring, options.people, 0.7, people);
  scene.trajectory = travel(kLegs, options);
  return scene;
}

}  // namespace tilth
