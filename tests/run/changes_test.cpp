// What left and what came within a run: a drive through a hospital in which, halfway, furniture is moved, taken away
// and added from one scan to the next. What truly changed is told by the two meshes.
#include <gtest/gtest.h>

#include <tilth/odometry/make_odometry.hpp>
#include <tilth/run/run_record.hpp>
#include <tilth/simulation/simulator.hpp>

namespace tilth {
namespace {

constexpr double kMoment = 15;  // [s] since the first scan

/// Two days in one place.
struct Days {
  Simulator before, after;

  Days(const std::string& seed, const std::string& changed)
      : before("hospital", simulation_options("hospital", {{"seed", seed}, {"duration", "30"}})),
        after("hospital", simulation_options("hospital", {{"seed", seed}, {"duration", "30"}, {"changed", changed}})) {}
};

MapBuilder map_of(const Days& days) {
  MapBuilder map(MapOptions{});
  const std::unique_ptr<Odometry> odometry = make_odometry("tilth");
  for (std::size_t i = 0; i < days.before.size(); ++i) {
    const bool early = days.before.stamp(i) < days.before.stamp(0) + kMoment;
    const Scan scan = (early ? days.before : days.after).scan(i).scan;
    map.add(odometry->register_scan(scan), scan.stamp);
  }
  map.settle();
  return map;
}

/// Share of the points of a change that lie on a mesh.
double share_on(const Simulator& day, const Change& change, const std::vector<MapPoint>& points) {
  const Pose T_scene_world = day.truth().front().T_world_lidar;
  std::vector<Eigen::Vector3d> inside;
  for (const MapPoint& p : points) {
    const Eigen::Vector3f at(p.x, p.y, p.z);
    if (change.box.contains(at)) inside.push_back(T_scene_world * at.cast<double>());
  }
  const std::vector<double> distances = day.world().distances(inside);
  const auto near = std::count_if(distances.begin(), distances.end(), [](double d) { return d < 0.1; });
  return inside.empty() ? 0 : double(near) / double(inside.size());
}

/// Whether it lies where a door leaf swings, which changes as well.
bool at_door(const Simulator& day, const Change& change) {
  const Eigen::Vector3d at = day.truth().front().T_world_lidar * change.box.center().cast<double>();
  const std::vector<Door>& doors = day.world().movers().doors;
  return std::any_of(doors.begin(), doors.end(),
                     [&](const Door& door) { return (door.hinge - at).head<2>().norm() < door.width + 0.1; });
}

TEST(ChangesOfARun, AreThoseOfTheScene) {
  const Days days("311", "0.8");
  const MapBuilder map = map_of(days);
  int left = 0, came = 0, wrong = 0;
  for (const Change& change : map.changes()) {
    if (at_door(days.before, change)) continue;
    const bool leaves = change.stay.kind == ChangeKind::left;
    const std::vector<MapPoint>& points = leaves ? map.moving() : map.points();
    const double on_before = share_on(days.before, change, points), on_after = share_on(days.after, change, points);
    const bool right = leaves ? on_before > 0.7 && on_after < 0.3 : on_after > 0.7 && on_before < 0.5;
    ++(!right ? wrong : leaves ? left : came);
    if (!right) continue;
    const double when = (leaves ? change.stay.last_seen : change.stay.first_seen) - days.before.stamp(0);
    EXPECT_NEAR(when, kMoment, leaves ? 1.0 : 10.0);  // what came is seen once it is in sight
  }
  RecordProperty("left", left), RecordProperty("came", came), RecordProperty("wrong", wrong);
  EXPECT_GE(left, 2);
  EXPECT_GE(came, 1);
  EXPECT_LE(wrong, 1);
}

}  // namespace
}  // namespace tilth
