// The map of a run: each scan undistorted and moved into the world, thinned to the first point of every voxel.
// Memory grows with the mapped space, never with time, and is bounded: a map that grows past its bound doubles its
// voxels. O(1) a point.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <tilth/core/options.hpp>
#include <tilth/core/point_cloud.hpp>
#include <tilth/core/point_records.hpp>
#include <tilth/core/scan_motion.hpp>
#include <tilth/core/se3.hpp>
#include <tilth/core/voxel_set.hpp>

namespace tilth {

struct MapOptions {
  double voxel = 0.1;                     ///< [m] edge of a voxel, which keeps one point
  std::uint64_t max_points = 20'000'000;  ///< voxels double in size rather than hold more
};

template <class V>
void visit(MapOptions& o, V&& v) {
  v("map_voxel", o.voxel, Bounds{0.001, 100}, "[m] edge of the voxels of the map, each of which keeps one point");
  v("map_max_points", o.max_points, Bounds{1000, 1e9},
    "[points] most that the map holds; past it the voxels double in size");
}

/// A point of the map, in the world frame.
struct MapPoint {
  float x = 0, y = 0, z = 0, intensity = 0;
  std::uint32_t scan = 0;  ///< number of the scan that saw it, from 0 in the order of add()
};

class MapBuilder {
 public:
  explicit MapBuilder(const MapOptions& options);

  /// Adds a scan whose sensor stood at `T_world_lidar` when `pose_time` ([s], on the clock of `cloud.times`) and moved
  /// about that instant as `motion` tells: a point of time t lies at T_world_lidar * T_reference_time * p, see
  /// ScanMotion. Points that are not finite are passed over.
  void add(const PointCloud& cloud, const Pose& T_world_lidar, double pose_time, const MotionInScan& motion);

  /// Moves the points of each scan by the motion of its number, in the world frame, and thins the map anew: what
  /// becomes of it when the poses of all scans are corrected. `T_new_old` has one motion a scan.
  void move(std::span<const Pose> T_new_old);

  std::size_t size() const { return points_.size(); }
  const std::vector<MapPoint>& points() const { return points_; }
  double voxel() const { return voxel_; }  ///< [m] in force; larger than asked for once the bound was met

  /// The map in the world frame: fields x y z intensity, 32-bit float, little endian.
  PointRecords records() const;

 private:
  void insert(const MapPoint& point);
  void rebuild();

  double voxel_;
  std::size_t max_points_;
  std::uint32_t scans_ = 0;
  std::vector<MapPoint> points_;
  VoxelSet voxels_;  // of points_
};

}  // namespace tilth
