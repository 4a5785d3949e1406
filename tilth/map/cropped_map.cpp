#include <tilth/core/voxel_downsample.hpp>
#include <tilth/map/cropped_map.hpp>

namespace tilth {

void CroppedMap::insert(std::span<const Eigen::Vector3d> points_in_map, const Eigen::Vector3d& center) {
  PointCloud inside;
  inside.points.reserve(cloud_.size() + points_in_map.size());
  for (const std::span<const Eigen::Vector3d> points : {cloud_.points(), points_in_map}) {
    for (const Eigen::Vector3d& p : points) {
      if ((p - center).cwiseAbs().maxCoeff() <= options_.half_width) inside.points.push_back(p);
    }
  }
  cloud_ = SearchableCloud(voxel_downsample(inside, options_.voxel_size).points);
}

PointCloud points_of(const CroppedMap& a, const CroppedMap& b) {
  PointCloud both;
  for (const CroppedMap* map : {&a, &b}) {
    const std::span<const Eigen::Vector3d> points = map->cloud().points();
    both.points.insert(both.points.end(), points.begin(), points.end());
  }
  return both;
}

}  // namespace tilth
