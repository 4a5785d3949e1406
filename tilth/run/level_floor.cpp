#include <cstdio>
#include <numbers>
#include <vector>

#include <tilth/core/error.hpp>
#include <tilth/run/level_floor.hpp>
#include <tilth/run/map_builder.hpp>

namespace tilth {

FloorPlane floor_below(Odometry& odometry, std::span<const Scan> scans, const Pose& T_base_lidar) {
  MapBuilder map(MapOptions{.keep_moving = true});
  for (const Scan& scan : scans) {
    if (scan.cloud.empty()) continue;
    map.add(odometry.register_scan(scan), scan.stamp);
  }
  map.settle();
  std::vector<Eigen::Vector3d> points;
  for (const MapPoint& p : map.points()) points.push_back(T_base_lidar * Eigen::Vector3d(p.x, p.y, p.z));
  const std::optional<FloorPlane> floor = find_floor(points, T_base_lidar.translation());
  if (!floor) {
    throw Error("level", "the first " + std::to_string(scans.size()) +
                             " scans show no floor below the LiDAR that is wide enough and within 45 degrees of level: "
                             "go without it, or say how the LiDAR is mounted (--base-from-lidar)");
  }
  return *floor;
}

std::string floor_sentence(const FloorPlane& floor) {
  char text[160];
  std::snprintf(text, sizeof text,
                "the floor lies %.2f m below the LiDAR and was tilted by %.2f deg, its %zu points %.0f mm about it",
                floor.depth, tilt_of(floor) * 180 / std::numbers::pi, floor.points, 1e3 * floor.thickness);
  return text;
}

}  // namespace tilth
