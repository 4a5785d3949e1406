// The floor plan of a simulated drive, held against the scene that it was driven through.
#include <queue>

#include <gtest/gtest.h>

#include <tilth/odometry/make_odometry.hpp>
#include <tilth/run/grid_sink.hpp>
#include <tilth/run/run_record.hpp>
#include <tilth/simulation/path.hpp>
#include <tilth/simulation/simulator.hpp>

namespace tilth {
namespace {

constexpr std::array kHeights{0.2, 0.3, 0.4, 0.5, 0.6, 0.72, 0.8, 0.9, 1.0, 1.2, 1.4, 1.7};  // [m] above the ground

/// A yard of 28 x 8 m between walls, whose ground rises by 0.8 m from x = 8 to x = 16 m, with bollards, a bench
/// and a crate.
double rise_of_yard(double x) {
  return std::clamp(0.1 * (x - 8), 0.0, 0.8);
}

Scene yard_with_ramp() {
  Scene scene;
  const SurfaceId wall = add_surface(scene.mesh, {"wall", Material::matte, 0.6});
  const SurfaceId ground = add_surface(scene.mesh, {"ground", Material::matte, 0.4});
  const std::array<double, 4> along{0, 8, 16, 28};
  for (std::size_t i = 0; i + 1 < along.size(); ++i) {
    const Eigen::Vector3d from(along[i], -4, rise_of_yard(along[i])), to(along[i + 1], -4, rise_of_yard(along[i + 1]));
    add_quad(scene.mesh, ground, from, {to - from, Eigen::Vector3d(0, 8, 0)}, kNoSides);
  }
  const std::array<Eigen::Vector3d, 5> corners{{{0, 4, 0}, {0, -4, 0}, {28, -4, 0}, {28, 4, 0}, {0, 4, 0}}};
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) add_wall(scene.mesh, wall, {corners[i], corners[i + 1], 4, {}});
  for (const double x : {5.0, 11.0, 14.0, 19.0})
    add_cylinder(scene.mesh, wall, upright({x, x > 12 ? 2.0 : -2.2, rise_of_yard(x)}, 0), 0.15, 1.0);
  add_box(scene.mesh, wall, upright({20.5, -2.5, 0.8}, 0.3), {2, 0.6, 0.5});
  add_box(scene.mesh, wall, upright({4.0, 2.7, 0}, -0.2), {0.8, 1.2, 0.7});
  const std::vector<Eigen::Vector3d> way{{2, 0, 0.8}, {8, 0, 0.8}, {16, 0.3, 1.6}, {25, 0, 1.6}};
  PathOptions path;
  path.cruise = 0.8;
  scene.trajectory = drive_through(way, path, {});
  return scene;
}

RunRecord drive(const Simulator& simulator) {
  RunRecord record;
  const std::unique_ptr<Odometry> odometry = make_odometry("tilth");
  for (std::size_t i = 0; i < simulator.size(); ++i) {
    const Scan scan = simulator.scan(i).scan;
    const OdometryResult result = odometry->register_scan(scan);
    record.map.add(result, scan.stamp);
    record.trajectory.push_back({result.stamp, result.T_world_lidar});
  }
  record.map.settle();
  return record;
}

/// The scene, seen in the world of the run.
class Truth {
 public:
  /// `rise` [m]: height of the ground over the x axis of the scene.
  Truth(const Simulator& simulator, const RunRecord& run, double (*rise)(double))
      : world_(simulator.world()),
        rise_(rise),
        T_scene_world_(pose_at(simulator.truth(), run.trajectory.front().stamp) *
                       run.trajectory.front().T_world_lidar.inverse()) {}

  /// What stands at `height` on the way from one place to another, nearest first; nothing where the way is free.
  std::optional<Eigen::Vector3d> between(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
    const Eigen::Vector3d way = T_scene_world_.linear() * (to - from);
    const Ray ray{T_scene_world_ * from, way.normalized(), 1.0};
    const Hit hit = world_.cast({&ray, 1}).front();
    if (!hit.met() || hit.moving || hit.distance > way.norm()) return std::nullopt;
    return from + (to - from).normalized() * hit.distance;
  }

  bool free(Eigen::Vector3d from, Eigen::Vector3d to) const {
    const Eigen::Vector3d place = T_scene_world_ * from;
    return std::none_of(kHeights.begin(), kHeights.end(), [&](double height) {
      from.z() = to.z() = rise_(place.x()) + height - T_scene_world_.translation().z();
      return between(from, to).has_value();
    });
  }

 private:
  static Pose pose_at(const Trajectory& trajectory, double stamp) {
    const auto next = std::lower_bound(trajectory.begin(), trajectory.end(), stamp,
                                       [](const StampedPose& pose, double t) { return pose.stamp < t; });
    return next->T_world_lidar;
  }

  const MeshWorld& world_;
  double (*rise_)(double);
  Pose T_scene_world_;
};

Eigen::Vector3d middle(const OccupancyGrid& grid, int column, int row) {
  const Eigen::Vector2d at = grid.origin + grid.resolution * Eigen::Vector2d(column + 0.5, row + 0.5);
  return {at.x(), at.y(), 0};
}

Eigen::Vector2i cell_of(const OccupancyGrid& grid, const Eigen::Vector3d& place) {
  return ((place.head<2>() - grid.origin) / grid.resolution).array().floor().cast<int>();
}

/// Share of the free cells that can truly be driven to from the way, over free cells.
double reachable(const OccupancyGrid& grid, const RunRecord& run, const Truth& truth) {
  std::vector<std::uint8_t> seen(grid.cells.size(), 0);
  std::queue<Eigen::Vector2i> open;
  for (const StampedPose& pose : run.trajectory) {
    const Eigen::Vector2i at = cell_of(grid, pose.T_world_lidar.translation());
    if (std::exchange(seen[grid.number(at.x(), at.y())], 1) == 0) open.push(at);
  }
  std::size_t reached = 0;
  for (; !open.empty(); open.pop(), ++reached) {
    const Eigen::Vector2i at = open.front();
    for (const Eigen::Vector2i& step : {Eigen::Vector2i(1, 0), Eigen::Vector2i(-1, 0), {0, 1}, {0, -1}}) {
      const Eigen::Vector2i to = at + step;
      if (!grid.contains(to.x(), to.y()) || grid.at(to.x(), to.y()) != Occupancy::free) continue;
      if (seen[grid.number(to.x(), to.y())] != 0) continue;
      if (!truth.free(middle(grid, at.x(), at.y()), middle(grid, to.x(), to.y()))) continue;
      seen[grid.number(to.x(), to.y())] = 1;
      open.push(to);
    }
  }
  return double(reached) / double(std::count(grid.cells.begin(), grid.cells.end(), Occupancy::free));
}

bool occupied_within_a_cell(const OccupancyGrid& grid, const Eigen::Vector2i& at) {
  for (int i = 0; i < 9; ++i) {
    const int c = at.x() + i % 3 - 1, r = at.y() + i / 3 - 1;
    if (grid.contains(c, r) && grid.at(c, r) == Occupancy::occupied) return true;
  }
  return false;
}

/// Share of the places, within 6 m of the way, where something stands in sight that are occupied within a cell.
double walls_found(const OccupancyGrid& grid, const RunRecord& run, const Truth& truth) {
  std::size_t walls = 0, found = 0;
  for (std::size_t i = 0; i + 30 < run.trajectory.size(); i += 10) {
    const Eigen::Vector3d from = run.trajectory[i].T_world_lidar.translation();
    for (int degree = 0; degree < 360; degree += 2) {
      const double angle = degree * std::numbers::pi / 180;
      const auto hit = truth.between(from, from + 6 * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0));
      if (!hit) continue;
      ++walls;
      found += occupied_within_a_cell(grid, cell_of(grid, *hit)) ? 1 : 0;
    }
  }
  return double(found) / double(walls);
}

struct Case {
  const char* scene;
  double (*rise)(double) = [](double) { return 0.0; };
};

Simulator simulator_of(const std::string& scene) {
  const OptionValues values{{"seed", "301"}, {"duration", "30"}};
  if (scene != "yard") return Simulator(scene, simulation_options(scene, values));
  const SimulationOptions options = simulation_options(kForeignScene, values);
  return Simulator(yard_with_ramp(), options);
}

class FloorPlan : public testing::TestWithParam<Case> {};

TEST_P(FloorPlan, IsThatOfTheScene) {
  const Simulator simulator = simulator_of(GetParam().scene);
  const RunRecord run = drive(simulator);
  const OccupancyGrid grid = occupancy_of(run, OccupancyOptions{});
  const Truth truth(simulator, run, GetParam().rise);
  const double free = reachable(grid, run, truth), walls = walls_found(grid, run, truth);
  RecordProperty("reachable", std::to_string(free));
  RecordProperty("walls", std::to_string(walls));
  EXPECT_GT(free, 0.99);
  EXPECT_GT(walls, 0.98);
  EXPECT_GT(std::count(grid.cells.begin(), grid.cells.end(), Occupancy::free), 8000);  // 20 square metres
}

INSTANTIATE_TEST_SUITE_P(Scenes, FloorPlan,
                         testing::Values(Case{"corridor"}, Case{"hospital"}, Case{"office"}, Case{"plaza"},
                                         Case{"yard", rise_of_yard}),
                         [](const auto& tested) { return std::string(tested.param.scene); });

}  // namespace
}  // namespace tilth
