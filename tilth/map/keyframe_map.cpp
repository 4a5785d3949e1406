#include <algorithm>

#include <tilth/core/voxel_downsample.hpp>
#include <tilth/map/keyframe_map.hpp>

namespace tilth {
namespace {

PointCloud moved(const PointCloud& cloud, const Pose& T_map_lidar) {
  PointCloud in_map;
  in_map.points.reserve(cloud.size());
  for (const Eigen::Vector3d& p : cloud.points) in_map.points.push_back(T_map_lidar * p);
  return in_map;
}

}  // namespace

void KeyframeMap::insert(double stamp, const Pose& T_map_lidar, const FeatureClouds& features_in_lidar) {
  stamps_.push_back(stamp);
  poses_.push_back(T_map_lidar);
  clouds_in_map_.push_back({moved(features_in_lidar.edges, T_map_lidar), moved(features_in_lidar.planes, T_map_lidar)});
}

std::vector<std::uint32_t> KeyframeMap::surrounding(const Eigen::Vector3d& center, double stamp) const {
  PointCloud positions;  // with their numbers as intensities
  const double radius_squared = options_.search_radius * options_.search_radius;
  for (std::uint32_t i = 0; i < poses_.size(); ++i) {
    if ((poses_[i].translation() - center).squaredNorm() > radius_squared) continue;
    positions.points.push_back(poses_[i].translation());
    positions.intensities.push_back(float(i));
  }
  const PointCloud cells = voxel_downsample(positions, options_.density);
  std::vector<std::uint32_t> keyframes;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    keyframes.push_back(options_.average_indices ? std::uint32_t(cells.intensities[c]) : nearest_to(cells.points[c]));
  }
  for (std::uint32_t i = 0; i < poses_.size(); ++i) {
    if (stamp - stamps_[i] < options_.recent) keyframes.push_back(i);
  }
  return keyframes;
}

FeatureClouds KeyframeMap::joined(std::span<const std::uint32_t> keyframes) const {
  FeatureClouds all;
  for (const std::uint32_t i : keyframes) {
    append(all.edges, clouds_in_map_[i].edges);
    append(all.planes, clouds_in_map_[i].planes);
  }
  return all;
}

std::uint32_t KeyframeMap::nearest_to(const Eigen::Vector3d& position) const {
  const auto nearer = [&](const Pose& a, const Pose& b) {
    return (a.translation() - position).squaredNorm() < (b.translation() - position).squaredNorm();
  };
  return std::uint32_t(std::min_element(poses_.begin(), poses_.end(), nearer) - poses_.begin());
}

}  // namespace tilth
