#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <tilth/simulation/layout.hpp>
#include <tilth/simulation/scenes.hpp>
#include <tilth/simulation/smooth_step.hpp>
#include <tilth/simulation/streetside.hpp>

namespace tilth {
namespace {

using Eigen::Vector3d;

constexpr int kStreets = 4;                          // along x, and as many along y
constexpr double kBlockX = 110.0, kBlockY = 90.0;    // [m] from street to street
constexpr double kStartX = 45.0;                     // [m] behind the drive's start, where the first crossing lies
constexpr double kBeyond = 40.0;                     // [m] by which streets along x and ground go on past the grid
constexpr double kCrossing = 14.0;                   // [m] from the middle of a crossing, free of parked cars
constexpr double kCruise = 9.0, kCornerSpeed = 4.5;  // [m/s]
constexpr double kRamp = 1.5, kTurn = 3.0;           // [s] from one of these speeds to the next, and round a corner
constexpr double kStill = 2.0;                       // [s] before the drive
constexpr std::uint64_t kStream = 0x70;

/// Crossings (number of the street along y, number of the one along x) at which the drive turns: six stretches are
/// driven both ways, one of them thrice.
constexpr std::array<std::array<int, 2>, 18> kRoute{{{2, 0},
                                                     {2, 1},
                                                     {1, 1},
                                                     {1, 0},
                                                     {3, 0},
                                                     {3, 2},
                                                     {1, 2},
                                                     {1, 1},
                                                     {2, 1},
                                                     {2, 3},
                                                     {0, 3},
                                                     {0, 2},
                                                     {2, 2},
                                                     {2, 0},
                                                     {1, 0},
                                                     {1, 1},
                                                     {0, 1},
                                                     {0, 0}}};

Vector3d crossing_at(int i, int j) {
  return {i * kBlockX - kStartX, j * kBlockY, 0};
}

/// [m] before and behind a corner that a turn to the side takes.
double corner_reach() {
  constexpr int kSteps = 1000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) sum += std::cos(0.5 * std::numbers::pi * smooth_step((i + 0.5) / kSteps));
  return kCornerSpeed * kTurn * sum / kSteps;
}

/// From rest to rest through the corners: at cruising speed in between, slower round them.
std::vector<Leg> legs_through(const Path& corners) {
  const double stop = 0.5 * kRamp * kCornerSpeed, reach = corner_reach(), ramp = 0.5 * kRamp * (kCornerSpeed + kCruise);
  std::vector<Leg> legs{{kStill, 0, 0}, {kRamp, kCornerSpeed, 0}};
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const bool last = i + 1 == corners.size();
    const Vector3d side = corners[i] - corners[i - 1];
    const double ends = (i == 1 ? stop : reach) + (last ? stop : reach) + 2 * ramp;
    legs.insert(legs.end(),
                {{kRamp, kCruise, 0}, {(side.norm() - ends) / kCruise, kCruise, 0}, {kRamp, kCornerSpeed, 0}});
    if (last) break;
    const Vector3d next = corners[i + 1] - corners[i];
    legs.push_back({kTurn, kCornerSpeed, std::atan2(side.cross(next).z(), side.dot(next))});
  }
  legs.push_back({kRamp, 0, 0});
  return legs;
}

Path route() {
  Path corners{Vector3d::Zero()};
  for (const auto& [i, j] : kRoute) corners.push_back(crossing_at(i, j));
  corners.push_back(Vector3d::Zero());
  return corners;
}

/// The middles of all streets, and the stretches from crossing to crossing.
struct Streets {
  std::vector<Path> along_x, along_y, stretches;
};

Streets streets() {
  Streets all;
  const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY();
  for (int k = 0; k < kStreets; ++k) {
    all.along_x.push_back(lengthened({crossing_at(0, k), crossing_at(kStreets - 1, k)}, kBeyond));
    all.along_y.push_back({crossing_at(k, 0), crossing_at(k, kStreets - 1)});
    for (int i = 0; i + 1 < kStreets; ++i) {
      all.stretches.push_back({crossing_at(i, k) + kCrossing * x, crossing_at(i + 1, k) - kCrossing * x});
      all.stretches.push_back({crossing_at(k, i) + kCrossing * y, crossing_at(k, i + 1) - kCrossing * y});
    }
  }
  return all;
}

/// Asphalt all over, and the blocks between the streets raised by the height of a kerb.
void add_ground(Mesh& mesh) {
  const SurfaceId asphalt = add_surface(mesh, {"asphalt", Material::matte, 0.2});
  const SurfaceId pavement = add_surface(mesh, {"pavement", Material::matte, 0.4});
  const Vector3d rim(kBeyond + 80, kBeyond + 80, 0), low = crossing_at(0, 0) - rim;
  const Vector3d size = crossing_at(kStreets - 1, kStreets - 1) + rim - low;
  add_quad(mesh, asphalt, low, {Vector3d(size.x(), 0, 0), Vector3d(0, size.y(), 0)}, kNoSides);
  const auto edge = [](int street, double block) {  // [m] between the kerbs of two streets, and past the outer ones
    const double from = street < 0 ? -kBeyond : street * block + kKerb;
    return std::pair{from, street + 1 == kStreets ? street * block + kBeyond : (street + 1) * block - kKerb};
  };
  for (int i = -1; i < kStreets; ++i) {
    for (int j = -1; j < kStreets; ++j) {
      const auto [x0, x1] = edge(i, kBlockX);
      const auto [y0, y1] = edge(j, kBlockY);
      const Vector3d middle(0.5 * (x0 + x1), 0.5 * (y0 + y1), 0);
      add_box(mesh, pavement, upright(crossing_at(0, 0) + middle, 0), {x1 - x0, y1 - y0, 0.12});
    }
  }
}

double distance_to_any(const std::vector<Path>& streets, const Vector3d& place) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Path& street : streets) nearest = std::min(nearest, distance_to(street, place));
  return nearest;
}

/// Rows of houses along all streets; those along x have the corners of the blocks.
void add_rows(Mesh& mesh, const Streets& all, double side, CounterRandom& random) {
  constexpr double kMore = 1.4, kCorner = 12.0;  // [m] so that no house stands across a street, nor in another one
  const auto is_free = [&](double from_x) {
    return [&all, from_x](const Vector3d& place, double clear) {
      return distance_to_any(all.along_x, place) > clear + from_x &&
             distance_to_any(all.along_y, place) > clear + kMore;
    };
  };
  for (const Path& street : all.along_x) add_houses(mesh, street, side, is_free(kMore), random);
  for (const Path& street : all.along_y) add_houses(mesh, street, side, is_free(kCorner), random);
}

std::vector<Walker> people_beside(const Streets& all, int count, CounterRandom& random) {
  std::vector<Walker> people;
  for (int i = 0; i < count; ++i) {
    const Path& street = (i % 2 == 0 ? all.along_x : all.along_y)[std::size_t(i / 2 % kStreets)];
    people.push_back(walkers_beside(street, 1, random.chance(0.5) ? 7.4 : -7.4, random).front());
  }
  return people;
}

}  // namespace

Scene city(const SceneOptions& options) {
  CounterRandom random(world_seed_of(options), kStream);
  const Streets all = streets();
  Scene scene;
  add_ground(scene.mesh);
  const auto anywhere = [](const Vector3d&, double) { return true; };  // the stretches end before the crossings
  for (const double side : {-1.0, 1.0}) {
    add_rows(scene.mesh, all, side, random);
    for (const Path& stretch : all.stretches) add_kerbside(scene.mesh, stretch, side, anywhere, random);
  }
  CounterRandom people = random_of_people(random, options);
  scene.movers.walkers = people_beside(all, options.people, people);
  scene.trajectory = travel(legs_through(route()), options);
  return scene;
}

}  // namespace tilth
