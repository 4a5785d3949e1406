#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include <tilth/core/scan_motion.hpp>
#include <tilth/output/map_builder.hpp>

namespace tilth {
namespace {

constexpr std::size_t kFirstSlots = 1 << 16;
constexpr double kLargestIndex = 1 << 20;  // of a voxel along an axis: 21 bits with its sign

/// Never zero, so that zero can mark a free slot; zero where the voxel lies outside what 21 bits an axis can say.
std::uint64_t voxel_key(double x, double y, double z, double voxel) {
  std::uint64_t key = 1;
  for (const double coordinate : {x, y, z}) {
    const double index = std::floor(coordinate / voxel);
    if (!(std::abs(index) < kLargestIndex)) return 0;
    key = key << 21 | std::uint64_t(index + kLargestIndex);
  }
  return key;
}

std::size_t hash_of(std::uint64_t key) {
  key *= 0x9E3779B97F4A7C15u;  // Fibonacci hashing
  return std::size_t(key ^ key >> 32);
}

/// Takes the voxel of `key`; false where it was taken before.
bool take(std::vector<std::uint64_t>& slots, std::uint64_t key) {
  const std::size_t mask = slots.size() - 1;
  std::size_t slot = hash_of(key) & mask;
  while (slots[slot] != 0) {
    if (slots[slot] == key) return false;
    slot = (slot + 1) & mask;
  }
  slots[slot] = key;
  return true;
}

}  // namespace

MapBuilder::MapBuilder(const MapOptions& options)
    : voxel_(options.voxel), max_points_(options.max_points), slots_(kFirstSlots, 0) {}

void MapBuilder::add(const PointCloud& cloud, const Pose& T_world_lidar, double pose_time, const Vector6d& velocity) {
  const bool timed = cloud.has_times();
  const double duration = timed ? *std::max_element(cloud.times.begin(), cloud.times.end()) : pose_time;
  const ScanMotion motion(velocity, pose_time, duration);
  const bool bright = cloud.intensities.size() == cloud.size();
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d p = T_world_lidar * motion.move(cloud.points[i], timed ? double(cloud.times[i]) : pose_time);
    insert({float(p.x()), float(p.y()), float(p.z()), bright ? cloud.intensities[i] : 0.0F, scans_});
  }
  ++scans_;
}

void MapBuilder::insert(const MapPoint& point) {
  const std::uint64_t key = voxel_key(point.x, point.y, point.z, voxel_);
  if (key == 0 || !take(slots_, key)) return;
  points_.push_back(point);
  if (points_.size() > max_points_) {
    voxel_ *= 2;
    rebuild(slots_.size());
  } else if (2 * points_.size() > slots_.size()) {
    rebuild(2 * slots_.size());
  }
}

void MapBuilder::move(std::span<const Pose> T_new_old) {
  for (MapPoint& point : points_) {
    const Eigen::Vector3d p = T_new_old[point.scan] * Eigen::Vector3d(point.x, point.y, point.z);
    point = {float(p.x()), float(p.y()), float(p.z()), point.intensity, point.scan};
  }
  rebuild(slots_.size());
}

void MapBuilder::rebuild(std::size_t slots) {
  slots_.assign(slots, 0);
  std::erase_if(points_, [&](const MapPoint& p) {
    const std::uint64_t key = voxel_key(p.x, p.y, p.z, voxel_);
    return key == 0 || !take(slots_, key);
  });
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
