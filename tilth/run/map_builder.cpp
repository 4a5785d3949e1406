#include <algorithm>
#include <bit>
#include <cstring>

#include <tilth/run/map_builder.hpp>

namespace tilth {
namespace {

/// Adds the voxel of the point; false where it was there before, or where it lies outside what the set can hold.
bool take(VoxelSet& voxels, const MapPoint& point, double voxel) {
  const Eigen::Vector3d place = Eigen::Vector3d(point.x, point.y, point.z) * (1 / voxel);
  return place.cwiseAbs().maxCoeff() < VoxelSet::kReach && voxels.insert(voxel_of(place));
}

}  // namespace

MapBuilder::MapBuilder(const MapOptions& options) : voxel_(options.voxel), max_points_(options.max_points) {}

void MapBuilder::add(const PointCloud& cloud, const Pose& T_world_lidar, double pose_time, const MotionInScan& motion) {
  const bool timed = cloud.has_times();
  const ScanMotion moved(motion, pose_time);
  const bool bright = cloud.intensities.size() == cloud.size();
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d p = T_world_lidar * moved.move(cloud.points[i], timed ? double(cloud.times[i]) : pose_time);
    insert({float(p.x()), float(p.y()), float(p.z()), bright ? cloud.intensities[i] : 0.0F, scans_});
  }
  ++scans_;
}

void MapBuilder::insert(const MapPoint& point) {
  if (!take(voxels_, point, voxel_)) return;
  points_.push_back(point);
  if (points_.size() <= max_points_) return;
  voxel_ *= 2;
  rebuild();
}

void MapBuilder::move(std::span<const Pose> T_new_old) {
  for (MapPoint& point : points_) {
    const Eigen::Vector3d p = T_new_old[point.scan] * Eigen::Vector3d(point.x, point.y, point.z);
    point = {float(p.x()), float(p.y()), float(p.z()), point.intensity, point.scan};
  }
  rebuild();
}

void MapBuilder::rebuild() {
  voxels_.clear();
  std::erase_if(points_, [&](const MapPoint& p) { return !take(voxels_, p, voxel_); });
}

PointRecords MapBuilder::records() const {
  PointRecords records;
  for (const char* name : {"x", "y", "z", "intensity"}) {
    records.fields.push_back({name, FieldType::f32, records.fields.size() * sizeof(float)});
  }
  records.stride = records.fields.size() * sizeof(float);
  records.count = points_.size();
  records.byte_order = std::endian::native;
  records.bytes.resize(records.stride * records.count);
  std::byte* to = records.bytes.data();
  for (const MapPoint& p : points_) {
    const float values[] = {p.x, p.y, p.z, p.intensity};
    std::memcpy(to, values, sizeof values);
    to += sizeof values;
  }
  return records;
}

}  // namespace tilth
