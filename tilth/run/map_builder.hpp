// The map of a run: each scan undistorted and moved into the world, thinned to the first point of every voxel, without
// what moved (freespace/moving_points.hpp). Memory grows with the mapped space, never with time, and is bounded: a map
// that grows past its bound doubles its voxels. O(1) a point.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <tilth/core/options.hpp>
#include <tilth/core/point_cloud.hpp>
#include <tilth/core/point_records.hpp>
#include <tilth/core/scan_motion.hpp>
#include <tilth/core/se3.hpp>
#include <tilth/core/voxel_set.hpp>
#include <tilth/freespace/moving_points.hpp>

namespace tilth {

struct OdometryResult;

struct MapOptions {
  double voxel = 0.1;                     ///< [m] edge of a voxel, which keeps one point
  std::uint64_t max_points = 20'000'000;  ///< voxels double in size rather than hold more
  bool keep_moving = false;               ///< points of what moves stay in the map
};

template <class V>
void visit(MapOptions& o, V&& v) {
  v("map_voxel", o.voxel, Bounds{0.001, 100}, "[m] edge of the voxels of the map, each of which keeps one point");
  v("map_max_points", o.max_points, Bounds{1000, 1e9},
    "[points] most that the map holds; past it the voxels double in size");
  v("keep_moving", o.keep_moving, "[-] leave points of people, cars and doors that move in the map");
}

/// A point of the map, in the world frame.
struct MapPoint {
  float x = 0, y = 0, z = 0, intensity = 0;
  std::uint32_t scan = 0;  ///< number of the scan that saw it, from 0 in the order of add()
};

/// Whether beams of a scan say what is free: only where its pose is believed.
struct ScanSight {
  double stamp = 0.0;    ///< [s]
  bool trusted = false;  ///< the pose is right to a few centimetres against those before
};

class MapBuilder {
 public:
  explicit MapBuilder(const MapOptions& options);

  /// Adds a scan whose sensor stood at `T_world_lidar` when `pose_time` ([s], on the clock of `cloud.times`) and moved
  /// about that instant as `motion` tells: a point of time t lies at T_world_lidar * T_reference_time * p, see
  /// ScanMotion. Points that are not finite are passed over.
  void add(const PointCloud& cloud, const Pose& T_world_lidar, double pose_time, const MotionInScan& motion,
           const ScanSight& sight = {});

  /// Adds a registered scan, whose first point has `stamp` [s].
  void add(const OdometryResult& result, double stamp);

  /// Decides of every point whether it moved; what is added later begins anew. To be called after the last scan.
  void settle();

  /// Moves the points of each scan by the motion of its number, in the world frame, and thins the map anew: what
  /// becomes of it when the poses of all scans are corrected. `T_new_old` has one motion a scan. Settles before.
  void move(std::span<const Pose> T_new_old);

  std::size_t size() const { return points_.size() + open_.size(); }

  /// Those that stand, and those that moved, one a voxel; both complete after settle().
  const std::vector<MapPoint>& points() const { return points_; }
  const std::vector<MapPoint>& moving() const { return moving_; }
  std::vector<Change> changes() const;     ///< what left or came while it was mapped; complete after settle()
  double voxel() const { return voxel_; }  ///< [m] in force; larger than asked for once the bound was met

  /// The map in the world frame: fields x y z intensity, 32-bit float, little endian. Before settle() what has been
  /// seen through so far is left out.
  PointRecords records() const;

  /// The map for a look at it: every n-th point, so that no more than `most` > 0 remain, also of those of which is not
  /// decided yet whether they moved. O(most).
  PointRecords thinned_records(std::size_t most) const;

 private:
  /// A point of which is not decided yet whether it moved.
  struct OpenPoint {
    MapPoint point;
    std::uint32_t thing = MovingPoints::kNone;
    bool released = false;  ///< what is seen in its voxel later is added as well
  };

  /// A point of something that stood and left, or came and stays.
  struct Changed {
    MapPoint point;
    Stay stay;
  };

  void add_watched(std::span<const MapPoint> points, SeenScan seen);
  void release_gone();
  void settle_far(const Eigen::Vector3f& place, float distance);
  bool gone(const OpenPoint& open) const;
  void take_out(const MapPoint& point);
  void note_change(const OpenPoint& open);
  void bound();
  void rebuild();

  double voxel_;
  std::size_t max_points_;
  std::uint32_t scans_ = 0;
  std::vector<MapPoint> points_, moving_;
  std::vector<OpenPoint> open_;
  std::vector<Changed> changed_;
  VoxelSet voxels_, moving_voxels_;  // of points_ and open_, of moving_
  std::optional<MovingPoints> sights_;
};

/// The points of a map as records: fields x y z intensity.
PointRecords to_records(std::span<const MapPoint> points);

}  // namespace tilth
