#include <algorithm>
#include <bit>
#include <cstring>
#include <iterator>

#include <tilth/odometry/odometry.hpp>
#include <tilth/run/map_builder.hpp>

namespace tilth {
namespace {

constexpr std::uint32_t kScansBetween = 200;  // two times at which what is far is decided
constexpr float kStillNear = 45;              // [m] beams may still pass there: MovingOptions::reach and a way to go
constexpr std::uint32_t kRelease = 20;        // scans between two times at which what has gone is looked for
constexpr std::size_t kOrigins = 64;          // of a scan

/// [s] of the k-th place of the sensor in a scan of `duration` [s].
double origin_time(std::size_t k, double duration) {
  return (double(k) + 0.5) / double(kOrigins) * duration;
}

/// Number of the place that the sensor was nearest to at `time` [s].
std::uint8_t origin_at(double time, double duration) {
  return std::uint8_t(std::clamp(time / duration * double(kOrigins), 0.0, double(kOrigins - 1)));
}

/// Adds the voxel of the point; false where it was there before, or where it lies outside what the set can hold.
bool take(VoxelSet& voxels, const MapPoint& point, double voxel) {
  const Eigen::Vector3d place = Eigen::Vector3d(point.x, point.y, point.z) * (1 / voxel);
  return place.cwiseAbs().maxCoeff() < VoxelSet::kReach && voxels.insert(voxel_of(place));
}

}  // namespace

MapBuilder::MapBuilder(const MapOptions& options) : voxel_(options.voxel), max_points_(options.max_points) {
  if (!options.keep_moving) sights_.emplace(MovingOptions{});
}

void MapBuilder::add(const PointCloud& cloud, const Pose& T_world_lidar, double pose_time, const MotionInScan& motion,
                     const ScanSight& sight) {
  const bool timed = cloud.has_times(), bright = cloud.intensities.size() == cloud.size();
  const ScanMotion moved(motion, pose_time);
  const auto place = [&](const Eigen::Vector3d& p, double time) -> Eigen::Vector3f {
    return (T_world_lidar * moved.move(p, time)).cast<float>();
  };
  std::vector<MapPoint> points(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3f p = place(cloud.points[i], timed ? double(cloud.times[i]) : pose_time);
    points[i] = {p.x(), p.y(), p.z(), bright ? cloud.intensities[i] : 0.0F, scans_};
  }
  if (sights_ && sight.trusted) {
    const double length = timed ? duration(cloud) : 0.0;
    SeenScan seen{sight.stamp, {}, {}, std::vector<std::uint8_t>(cloud.size(), 0)};
    for (std::size_t k = 0; k < (length > 0 ? kOrigins : 1); ++k)
      seen.origins.push_back(place(Eigen::Vector3d::Zero(), timed ? origin_time(k, length) : pose_time));
    for (std::size_t i = 0; length > 0 && i < cloud.size(); ++i) seen.origin_of[i] = origin_at(cloud.times[i], length);
    add_watched(points, std::move(seen));
  } else {
    std::copy_if(points.begin(), points.end(), std::back_inserter(points_),
                 [&](const MapPoint& p) { return take(voxels_, p, voxel_); });
  }
  bound();
  ++scans_;
}

void MapBuilder::add(const OdometryResult& result, double stamp) {
  const bool trusted = result.in_map && result.track.state == TrackState::tracking;
  add(result.filtered, result.T_world_lidar, result.stamp - stamp, result.motion, {result.stamp, trusted});
}

void MapBuilder::add_watched(std::span<const MapPoint> points, SeenScan seen) {
  std::vector<Eigen::Vector3f> fresh;
  const std::size_t before = open_.size();
  for (const MapPoint& p : points) {
    seen.points.emplace_back(p.x, p.y, p.z);
    if (!take(voxels_, p, voxel_)) continue;
    open_.push_back({p});
    fresh.push_back(seen.points.back());
  }
  const std::vector<std::uint32_t> things = sights_->add(seen, fresh);
  for (std::size_t i = 0; i < things.size(); ++i) open_[before + i].thing = things[i];
  if (sights_->scans() % kRelease == 0) release_gone();
  if (sights_->scans() % kScansBetween == 0) settle_far(seen.place(), kStillNear);
}

/// Lets the voxels of what has gone take another point.
void MapBuilder::release_gone() {
  for (OpenPoint& open : open_) {
    if (open.released || !sights_->gone(open.thing)) continue;
    open.released = true;
    voxels_.erase(voxel_of(Eigen::Vector3d(open.point.x, open.point.y, open.point.z) * (1 / voxel_)));
  }
}

bool MapBuilder::gone(const OpenPoint& open) const {
  return sights_->moved(open.thing);
}

void MapBuilder::take_out(const MapPoint& point) {
  if (take(moving_voxels_, point, voxel_)) moving_.push_back(point);
}

void MapBuilder::note_change(const OpenPoint& open) {
  if (const std::optional<Stay> stay = sights_->changed(open.thing)) changed_.push_back({open.point, *stay});
}

/// Decides of the points that are farther than `distance` from `place`, and forgets what was seen there.
void MapBuilder::settle_far(const Eigen::Vector3f& place, float distance) {
  sights_->judge(place, distance);
  std::erase_if(open_, [&](const OpenPoint& open) {
    if (!sights_->judged(open.thing)) return false;
    note_change(open);
    if (gone(open))
      take_out(open.point);
    else
      points_.push_back(open.point);
    return true;
  });
  const std::vector<std::uint32_t> renumbered = sights_->forget(place, distance);
  for (OpenPoint& open : open_) open.thing = renumbered[open.thing];
}

void MapBuilder::settle() {
  if (sights_) settle_far(Eigen::Vector3f::Zero(), 0);
}

/// Doubles the voxels until the map fits its bound.
void MapBuilder::bound() {
  while (size() > max_points_) {
    voxel_ *= 2;
    rebuild();
  }
}

void MapBuilder::move(std::span<const Pose> T_new_old) {
  settle();
  const auto move = [&](MapPoint& point) {
    const Eigen::Vector3d p = T_new_old[point.scan] * Eigen::Vector3d(point.x, point.y, point.z);
    point = {float(p.x()), float(p.y()), float(p.z()), point.intensity, point.scan};
  };
  std::for_each(points_.begin(), points_.end(), move);
  std::for_each(moving_.begin(), moving_.end(), move);
  for (Changed& changed : changed_) move(changed.point);
  rebuild();
}

void MapBuilder::rebuild() {
  voxels_.clear(), moving_voxels_.clear();
  std::erase_if(moving_, [&](const MapPoint& p) { return !take(moving_voxels_, p, voxel_); });
  std::erase_if(points_, [&](const MapPoint& p) { return !take(voxels_, p, voxel_); });
  std::erase_if(open_, [&](const OpenPoint& open) {
    if (!gone(open)) return !take(voxels_, open.point, voxel_);
    take_out(open.point);
    return true;
  });
}

std::vector<Change> MapBuilder::changes() const {
  std::vector<ChangedPoint> points;
  for (const Changed& c : changed_) points.push_back({{c.point.x, c.point.y, c.point.z}, c.stay});
  return changes_of(points);
}

PointRecords MapBuilder::records() const {
  if (open_.empty()) return to_records(points_);
  std::vector<MapPoint> all = points_;
  for (const OpenPoint& open : open_) {
    if (!gone(open)) all.push_back(open.point);
  }
  return to_records(all);
}

PointRecords MapBuilder::thinned_records(std::size_t most) const {
  const std::size_t every = std::max<std::size_t>(1, (size() + most - 1) / most);
  std::vector<MapPoint> chosen;
  for (std::size_t i = 0; i < size(); i += every)
    chosen.push_back(i < points_.size() ? points_[i] : open_[i - points_.size()].point);
  return to_records(chosen);
}

PointRecords to_records(std::span<const MapPoint> points) {
  PointRecords records;
  for (const char* name : {"x", "y", "z", "intensity"}) {
    records.fields.push_back({name, FieldType::f32, records.fields.size() * sizeof(float)});
  }
  records.stride = records.fields.size() * sizeof(float);
  records.count = points.size();
  records.byte_order = std::endian::native;
  records.bytes.resize(records.stride * records.count);
  std::byte* to = records.bytes.data();
  for (const MapPoint& p : points) {
    const float values[] = {p.x, p.y, p.z, p.intensity};
    std::memcpy(to, values, sizeof values);
    to += sizeof values;
  }
  return records;
}

}  // namespace tilth
