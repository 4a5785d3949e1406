#include <cmath>
#include <numbers>

#include <tilth/simulation/corridor_shell.hpp>
#include <tilth/simulation/rooms_beside.hpp>
#include <tilth/simulation/scenes.hpp>

namespace tilth {
namespace {

constexpr double kQuarter = std::numbers::pi / 2;
constexpr double kHalfWidth = 1.4, kHeight = 2.8;  // [m]
constexpr std::uint64_t kStream = 0x30;

const std::vector<Leg> kLegs{{5, 0, 0}, {20, 0.6, 0}, {16, 0.75, 0},        {3.5, 0.5, -kQuarter}, {12, 0.7, 0},
                             {3, 0, 0}, {14, 0.7, 0}, {3.5, 0.5, kQuarter}, {22, 0.7, 0},          {4, 0, 0}};

void furnish_ward(Mesh& mesh, Movers& movers, const RoomsBeside::Taken& ward, CounterRandom& random) {
  const Room& room = ward.room;
  add_room(mesh, room, ward.door_width);
  const double far = room.wall + room.depth, side = room.width / 2;
  const Pose& T = room.T_world_entry;
  for (const double ratio : {0.35, 0.75}) {
    const double x = room.wall + ratio * room.depth;
    add_bed(mesh, T * upright({x, side, 0}, std::numbers::pi));
    add_cabinet(mesh, T * upright({x + 0.75, side, 0}, std::numbers::pi), {0.45, 0.4, 0.85});
  }
  add_cabinet(mesh, T * upright({far - 0.6, -side, 0}, 0), {0.9, 0.5, 1.9});
  if (!random.chance(0.6)) return;
  Door door;
  door.hinge = T * Eigen::Vector3d(0.18, -ward.door_width / 2, 0);
  door.closed_yaw = std::atan2(T.linear()(1, 1), T.linear()(0, 1));
  door.swing = -random.uniform(1.2, 1.5), door.width = ward.door_width;
  door.period = random.uniform(14, 30), door.phase = random.uniform(0, 30);
  movers.doors.push_back(door);
}

/// Trolleys and cupboards along the corridor: bare metal, low or tall.
void add_corridor_cabinet(Mesh& mesh, const Pose& T_world_foot, double width) {
  const bool tall = width > 1.25;
  add_cabinet(mesh, T_world_foot, {0.75 * width, 0.42, tall ? 1.9 : 0.95});
}

}  // namespace

Scene hospital(const SceneOptions& options) {
  CounterRandom random(world_seed_of(options), kStream);
  const Path whole = lengthened(path_of(kLegs), 4.0);
  CorridorStyle style;
  style.half_width = kHalfWidth, style.height = kHeight, style.least_gap = 0.9, style.most_gap = 3.0;
  style.adorned = 0.3, style.adorn = add_corridor_cabinet;
  RoomsBeside wards(whole, kHalfWidth);
  style.opens = [&](const Pose& T_world_entry, double width) {
    return random.chance(0.75) && wards.take({T_world_entry, 4.4, 5.0, kHeight}, width);
  };
  Scene scene;
  add_corridor(scene.mesh, whole, style, random);
  for (const RoomsBeside::Taken& ward : wards.taken()) furnish_ward(scene.mesh, scene.movers, ward, random);
  CounterRandom people = random_of_people(random, options);
  scene.movers.walkers = walkers_beside(lengthened(whole, -0.7), options.people, 0.8, people);
  scene.trajectory = travel(kLegs, options);
  return scene;
}

}  // namespace tilth
